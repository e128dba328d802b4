// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "sensitivity/independent_check.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "description/tuned_parameters.h"
#include "math/arrays.h"

namespace codesign {
namespace {

// Components of a gradient below this share of the largest one count less in the direction, and
// values below this share of a range move by it.
constexpr double kLeastComponent = 0.03, kLeastOfRange = 0.01;
// The first step in the magnitude of the parameter that moves most, and the least share of it for
// which bounds must leave room.
constexpr double kFirstStep = 0x1p-7, kLeastRoom = 1.0 / 16.0;
// allowed_difference().
constexpr double kOfGradient = 1e-3, kOfObjective = 1e-4, kOfRange = 1e-4;

double magnitude(const Parameter& parameter, double value) {
  const double range = extent(parameter, value);
  double size = has_range(parameter)
                    ? std::min(range, std::max(std::abs(value), kLeastOfRange * range))
                    : range;
  if (!(size > 0.0)) size = 1.0;
  return size;
}

double room(const Parameter& parameter, double value, double by) {
  if (by == 0.0) return std::numeric_limits<double>::infinity();
  return std::abs((by > 0.0 ? parameter.upper : parameter.lower) - value) / std::abs(by);
}

}  // namespace

CheckedLine checked_line(const MotionStudy& study, const Eigen::VectorXd& rho,
                         const Eigen::VectorXd& gradient) {
  const Eigen::Index count = rho.size();
  const auto parameter = [&study](Eigen::Index k) -> const Parameter& {
    return tuned_parameter(study, k);
  };
  Eigen::VectorXd sizes(count);
  for (Eigen::Index k = 0; k < count; ++k) sizes[k] = magnitude(parameter(k), rho[k]);
  const Eigen::VectorXd slopes = gradient.cwiseProduct(sizes).cwiseAbs();
  const double largest = slopes.maxCoeff(), floor = kLeastComponent * largest;
  std::mt19937 bits(1);  // its sequence is the same everywhere
  Eigen::VectorXd parts(count);
  for (Eigen::Index k = 0; k < count; ++k) {
    // Not all of one size, so that a common factor does not cancel.
    const double part = 0.5 + static_cast<double>(bits()) / 4294967296.0;
    const bool is_negative =
        count > 1 && (gradient[k] != 0.0 ? gradient[k] < 0.0 : static_cast<bool>(bits() % 2 != 0));
    parts[k] = (is_negative ? -part : part) / (floor > 0.0 ? std::max(slopes[k], floor) : 1.0);
  }
  parts /= count == 1 ? std::abs(parts[0]) * sizes[0] : parts.cwiseAbs().maxCoeff();
  CheckedLine line;
  line.direction = parts.cwiseProduct(sizes);
  const double whole = kFirstStep / parts.cwiseAbs().maxCoeff();
  double forward = whole, backward = whole;
  for (Eigen::Index k = 0; k < count; ++k) {
    double& by = line.direction[k];
    if (room(parameter(k), rho[k], by) < kLeastRoom * whole) by = -by;
    forward = std::min(forward, room(parameter(k), rho[k], by));
    backward = std::min(backward, room(parameter(k), rho[k], -by));
    line.per_range =
        std::max(line.per_range, std::abs(by) / std::max(extent(parameter(k), rho[k]), sizes[k]));
  }
  line.is_two_sided = std::min(forward, backward) >= kLeastRoom * whole;
  line.first_step = line.is_two_sided ? std::min(forward, backward) : std::max(forward, backward);
  if (!line.is_two_sided && backward > forward) line.direction = -line.direction;
  return line;
}

double LineDifferences::quotient(double h, double at_zero, double forward, double backward) const {
  return is_two_sided_ ? (forward - backward) / (2.0 * h) : (forward - at_zero) / h;
}

void LineDifferences::add(double h, double forward, double backward) {
  if (levels_ == kMostLevels) return;
  const auto i = to_index(levels_++);
  steps_[i] = h;
  kinks_[i] = is_two_sided_ ? (forward - 2.0 * at_zero_ + backward) / (2.0 * h) : 0.0;
  table_[i][0] = quotient(h, at_zero_, forward, backward);
  if (i == 0) {
    value_ = table_[0][0];
    error_ = std::numeric_limits<double>::infinity();
    return;
  }
  const double shrink = steps_[i - 1] / h, by_order = is_two_sided_ ? shrink * shrink : shrink;
  const double last = table_[i][0], before = table_[i - 1][0];
  curvature_ =
      std::abs(is_two_sided_ ? 2.0 * kinks_[i] / h : 2.0 * (before - last) / (steps_[i - 1] - h));
  // Of a smooth function the slopes of both sides meet.
  const double kink = std::abs((shrink * kinks_[i] - kinks_[i - 1]) / (shrink - 1.0));
  double factor = by_order, error = std::numeric_limits<double>::infinity(), value = 0.0;
  for (std::size_t j = 1; j <= i; ++j, factor *= by_order) {
    table_[i][j] = (factor * table_[i][j - 1] - table_[i - 1][j - 1]) / (factor - 1.0);
    const double change = std::max(std::abs(table_[i][j] - table_[i][j - 1]),
                                   std::abs(table_[i][j] - table_[i - 1][j - 1])) +
                          kink;
    if (!(change < error)) continue;
    error = change;
    value = table_[i][j];
  }
  // A level whose error is larger is rounding, unless it refutes those before: two of them may
  // agree by accident, as beside a singular design.
  if (!(error < error_) && !(std::abs(value - value_) > error + error_)) return;
  value_ = value;
  error_ = error;
  used_ = i;
}

// The changes of a smooth function fall by 16, on one side by 4; those beside |x|^(1/2) double.
bool LineDifferences::diverges() const {
  constexpr double kLeastRatio = 0.5, kLeastShare = 0.2;
  if (levels_ < 3) return false;
  const auto i = to_index(levels_ - 1);
  const double last = table_[i][0] - table_[i - 1][0], before = table_[i - 1][0] - table_[i - 2][0];
  return last * before > 0.0 && std::abs(last) > kLeastRatio * std::abs(before) &&
         std::abs(last) > kLeastShare * std::abs(table_[i][0]);
}

double allowed_difference(const IndependentCheck& check, const CheckedLine& line, double objective,
                          double curvature) {
  return std::max({kOfGradient * check.size, kOfObjective * std::abs(objective) * line.per_range,
                   line.per_range > 0.0 ? kOfRange * curvature / line.per_range : 0.0});
}

}  // namespace codesign
