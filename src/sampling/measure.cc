// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "sampling/measure.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

#include "math/arrays.h"

namespace codesign {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

// Sum of w_i x_i in the order of i: Eigen's order depends on the width of the processor's vectors.
double weighted_sum(const VectorXd& weights, const VectorXd& x) {
  double sum = 0.0;
  for (Index i = 0; i < x.size(); ++i) sum += weights[i] * x[i];
  return sum;
}

// Relative to the first value, so that the mean of equal values is exact.
double weighted_mean(const VectorXd& weights, const VectorXd& x) {
  return x[0] + weighted_sum(weights, (x.array() - x[0]).matrix());
}

// sqrt(sum w_i (psi_i - mean)^2), whose derivative is w_i (psi_i - mean) / deviation.
Measured mean_plus_deviation(double factor, const VectorXd& values, const VectorXd& weights) {
  const double mean = weighted_mean(weights, values);
  const VectorXd from_mean = (values.array() - mean).matrix();
  const double deviation = std::sqrt(weighted_sum(weights, from_mean.cwiseAbs2()));
  Measured result{mean + factor * deviation, weights};
  if (deviation > 0.0) result.by_value.array() *= 1.0 + factor / deviation * from_mean.array();
  return result;
}

Measured worst(const VectorXd& values) {
  Index largest = 0;
  for (Index i = 1; i < values.size(); ++i) {
    if (values[i] > values[largest]) largest = i;
  }
  return {values[largest], VectorXd::Unit(values.size(), largest), values[largest]};
}

// Places of the values from the largest to the smallest; equal ones keep their order.
std::vector<Index> worst_first(const VectorXd& values) {
  std::vector<Index> order(to_index(values.size()));
  std::iota(order.begin(), order.end(), Index{0});
  std::stable_sort(order.begin(), order.end(),
                   [&values](Index a, Index b) { return values[a] > values[b]; });
  return order;
}

// The minimum over t of t + sum w_i max(psi_i - t, 0) / (1 - level), doc/theory.md [16]: the mean
// of the worst values with a total weight of 1 - level; the last of these may count with a part of
// its weight.
Measured conditional_value_at_risk(double level, const VectorXd& values, const VectorXd& weights) {
  // Relative to 1 - level; a rest below it is rounding, not a part of the next value's weight.
  constexpr double kRounding = 1e-12;
  const double slack = kRounding * (1.0 - level);
  double rest = 1.0 - level, counted = 0.0;
  Measured result{0.0, VectorXd::Zero(values.size())};
  for (const Index i : worst_first(values)) {
    const double share = rest > slack ? std::min(weights[i], rest) : 0.0;
    result.by_value[i] = share;
    result.threshold = values[i];
    counted += share;
    if (weights[i] > rest + slack) break;
    rest -= weights[i];
  }
  result.by_value /= counted;
  result.value = weighted_mean(result.by_value, values);
  return result;
}

}  // namespace

VectorXd grouped(const RobustOptions& options, const VectorXd& values, const VectorXd& weights,
                 Eigen::MatrixXd* by_value) {
  if (options.groups.empty()) {
    if (by_value) by_value->setIdentity(values.size(), values.size());
    return values;
  }
  const Index count = 1 + *std::max_element(options.groups.begin(), options.groups.end());
  const auto group_of = [&options](Index i) { return Index{options.groups[to_index(i)]}; };
  VectorXd sums = VectorXd::Zero(count), means = VectorXd::Zero(count);
  for (Index i = 0; i < values.size(); ++i) sums[group_of(i)] += weights[i];
  for (Index i = 0; i < values.size(); ++i)
    means[group_of(i)] += weights[i] / sums[group_of(i)] * values[i];
  if (!by_value) return means;
  by_value->setZero(count, values.size());
  for (Index i = 0; i < values.size(); ++i)
    (*by_value)(group_of(i), i) = weights[i] / sums[group_of(i)];
  return means;
}

namespace {

Measured worst_mean(const RobustOptions& options, const VectorXd& values, const VectorXd& weights) {
  Eigen::MatrixXd shares;
  const Measured of_means = worst(grouped(options, values, weights, &shares));
  return {of_means.value, shares.transpose() * of_means.by_value, of_means.threshold};
}

}  // namespace

Measured measure(const RobustOptions& options, const VectorXd& values, const VectorXd& weights) {
  switch (options.measure) {
    case RobustMeasure::kWorst:
      return options.groups.empty() ? worst(values) : worst_mean(options, values, weights);
    case RobustMeasure::kCvar:
      return conditional_value_at_risk(options.level, values, weights);
    case RobustMeasure::kMeanPlusDeviation:
      return mean_plus_deviation(options.factor, values, weights);
    case RobustMeasure::kMean:
      break;
  }
  return {weighted_mean(weights, values), weights};
}

}  // namespace codesign
