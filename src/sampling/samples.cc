// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "sampling/samples.h"

#include <algorithm>
#include <boost/math/special_functions/erf.hpp>
#include <cmath>

#include "math/arrays.h"
#include "sampling/sampler.h"

namespace codesign {
namespace {

/// The distribution of a quantity, given the values of the quantities before it.
Distribution given(const std::vector<UncertainQuantity>& quantities, std::size_t index,
                   const std::vector<double>& earlier) {
  Distribution distribution = quantities[index].distribution;
  for (const MeanSlope& on : quantities[index].slopes)
    distribution.mean +=
        on.slope * (earlier[on.quantity] - quantities[on.quantity].distribution.mean);
  return distribution;
}

constexpr double kSqrt2 = 1.4142135623730950488;

// No long double, whose width differs from platform to platform; probability zero is at infinity
// and no error.
namespace policies = boost::math::policies;
using Policy = policies::policy<policies::promote_double<false>,
                                policies::overflow_error<policies::ignore_error>>;

// Probability that a standard normal number exceeds x, and the x that is exceeded with a
// probability of at most 1/2.
double tail(double x) { return 0.5 * std::erfc(x / kSqrt2); }
double exceeded_with(double probability) {
  return kSqrt2 * boost::math::erfc_inv(2.0 * probability, Policy());
}

// Both the probabilities p below and q = 1 - p above the value are computed without subtracting
// from one, and the smaller one is inverted: far out in a tail, the larger one has lost its digits.
double normal_quantile(const Distribution& d, double u) {
  if (!(d.deviation > 0.0)) return std::clamp(d.mean, d.lower, d.upper);
  const double from = (d.lower - d.mean) / d.deviation, to = (d.upper - d.mean) / d.deviation;
  const double below = tail(-to) - tail(-from), above = tail(from) - tail(to);
  if (below <= 0.0 && above <= 0.0) return std::clamp(d.mean, d.lower, d.upper);
  const double p = tail(-from) + u * below, q = tail(to) + (1.0 - u) * above;
  const double x = p < q ? -exceeded_with(p) : exceeded_with(std::min(q, 0.5));
  return std::clamp(d.mean + d.deviation * x, d.lower, d.upper);
}

/// One sample per row of points of the unit cube.
std::vector<std::vector<double>> samples_at(const std::vector<UncertainQuantity>& quantities,
                                            const Eigen::MatrixXd& points) {
  std::vector<std::vector<double>> samples(to_index(points.rows()));
  for (std::size_t i = 0; i < samples.size(); ++i) {
    samples[i].reserve(quantities.size());
    for (std::size_t j = 0; j < quantities.size(); ++j) {
      samples[i].push_back(
          quantile(given(quantities, j, samples[i]), points(to_signed(i), to_signed(j))));
    }
  }
  return samples;
}

/// The points of a quantity that corners have.
std::vector<double> places(const Distribution& distribution) {
  constexpr double kEnd = 0x1p-33;
  if (distribution.kind == DistributionKind::kUniform) return {kEnd, 1.0 - kEnd};
  if (distribution.kind == DistributionKind::kNormal) return {0.5};
  std::vector<double> middles;
  const auto count = static_cast<double>(distribution.choices.size());
  for (double k = 0.5; k < count; ++k) middles.push_back(k / count);
  return middles;
}

}  // namespace

std::vector<std::vector<double>> corners(const std::vector<UncertainQuantity>& quantities) {
  std::size_t count = 1;
  bool has_interval = false;
  for (const UncertainQuantity& quantity : quantities) {
    has_interval |= quantity.distribution.kind == DistributionKind::kUniform;
    count *= places(quantity.distribution).size();
    if (count > kMostCorners) return {};
  }
  if (!has_interval) return {};
  Eigen::MatrixXd points(to_signed(count), to_signed(quantities.size()));
  std::size_t repeated = 1;
  for (std::size_t j = 0; j < quantities.size(); ++j) {
    const std::vector<double> at = places(quantities[j].distribution);
    for (std::size_t i = 0; i < count; ++i)
      points(to_signed(i), to_signed(j)) = at[i / repeated % at.size()];
    repeated *= at.size();
  }
  return samples_at(quantities, points);
}

std::vector<std::vector<double>> draw(const std::vector<UncertainQuantity>& quantities,
                                      SamplerKind sampler, int count, std::uint32_t seed) {
  return samples_at(quantities,
                    unit_points(sampler, count, static_cast<int>(quantities.size()), seed));
}

double quantile(const Distribution& distribution, double u) {
  switch (distribution.kind) {
    case DistributionKind::kUniform:
      return distribution.lower + u * (distribution.upper - distribution.lower);
    case DistributionKind::kNormal:
      return normal_quantile(distribution, u);
    case DistributionKind::kChoice:
      break;
  }
  const std::size_t size = distribution.choices.size();
  return distribution
      .choices[std::min(static_cast<std::size_t>(u * static_cast<double>(size)), size - 1)];
}

}  // namespace codesign
