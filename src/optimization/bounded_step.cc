// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "optimization/bounded_step.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "math/arrays.h"
#include "math/dense.h"

namespace codesign {
namespace {

using Eigen::Index;
constexpr double kLeastDamping = 1e-16;  // for columns of norm 1
constexpr double kNull = 1e-9;  // relative to the largest singular value: smaller ones are rounding
// Relative to the gradient: a component on a bound stays there if leaving it would gain less.
constexpr double kRounding = 1e-12;
constexpr int kMostBisections = 60;

}  // namespace

BoundedStep::BoundedStep(const Eigen::VectorXd& gradient, const Eigen::MatrixXd& root,
                         Eigen::VectorXd scale, Eigen::VectorXd lower, Eigen::VectorXd upper)
    : scale_(std::move(scale)),
      gradient_(gradient.cwiseQuotient(scale_)),
      root_(root * scale_.cwiseInverse().asDiagonal()),
      step_lower_(std::move(lower)),
      step_upper_(std::move(upper)),
      lower_(step_lower_.cwiseProduct(scale_)),
      upper_(step_upper_.cwiseProduct(scale_)) {
  hold_null_directions();
}

// Singular values that are rounding are replaced by the largest one, and the gradient, which is
// zero along their directions but for rounding, by its part across them.
void BoundedStep::hold_null_directions() {
  const SingularValues svd = singular_values(root_, SingularVectors::kRight);
  Eigen::VectorXd values = Eigen::VectorXd::Zero(root_.cols());
  values.head(svd.values.size()) = svd.values;
  if (values.size() == 0 || values[values.size() - 1] > kNull * values[0] || values[0] == 0.0)
    return;
  for (Index k = 0; k < values.size(); ++k) {
    if (values[k] > kNull * values[0]) continue;
    values[k] = values[0];
    gradient_ -= svd.V.col(k).dot(gradient_) * svd.V.col(k);
  }
  root_ = values.asDiagonal() * svd.V.transpose();
}

Eigen::VectorXd BoundedStep::damped(double mu) const {
  const auto size = to_index(gradient_.size());
  Eigen::VectorXd y = Eigen::VectorXd::Zero(gradient_.size());
  std::vector<AtBound> places(size, AtBound::kFree);
  for (std::size_t k = 0; k < size; ++k) {
    const auto i = static_cast<Index>(k);
    if (lower_[i] == 0.0 && gradient_[i] > 0.0) places[k] = AtBound::kLower;
    if (upper_[i] == 0.0 && gradient_[i] < 0.0) places[k] = AtBound::kUpper;
  }
  // Each set of free components is visited once at most, since the problem is strictly convex;
  // rounding could break that.
  for (std::size_t round = 0; round < 10 * size + 10; ++round) {
    std::vector<Index> free;
    for (std::size_t k = 0; k < size; ++k)
      if (places[k] == AtBound::kFree) free.push_back(static_cast<Index>(k));
    Eigen::VectorXd target = y;
    solve_free(mu, free, &target);
    if (move_towards(target, free, &places, &y) && !release(mu, y, &places)) break;
  }
  return unscaled(y, places);
}

// (A_F^T A_F + mu) y_F = -g_F / 2 - A_F^T A y_held, with one step of refinement.
void BoundedStep::solve_free(double mu, const std::vector<Index>& free, Eigen::VectorXd* y) const {
  const auto count = static_cast<Index>(free.size());
  if (count == 0) return;
  Eigen::MatrixXd stacked = Eigen::MatrixXd::Zero(root_.rows() + count, count);
  Eigen::VectorXd held = *y, slope(count);
  for (Index k = 0; k < count; ++k) {
    const Index i = free[to_index(k)];
    stacked.col(k).head(root_.rows()) = root_.col(i);
    stacked(root_.rows() + k, k) = std::sqrt(mu);
    held[i] = 0.0;
    slope[k] = gradient_[i];
  }
  const auto columns = stacked.topRows(root_.rows());
  const Eigen::VectorXd right = -0.5 * slope - columns.transpose() * (root_ * held);
  const Eigen::MatrixXd K = triangular_root(stacked);
  const auto solve = [&K](Eigen::VectorXd b) {
    K.triangularView<Eigen::Upper>().transpose().solveInPlace(b);
    K.triangularView<Eigen::Upper>().solveInPlace(b);
    return b;
  };
  Eigen::VectorXd solution = solve(right);
  solution += solve(right - stacked.transpose() * (stacked * solution));
  for (Index k = 0; k < count; ++k) (*y)[free[to_index(k)]] = solution[k];
}

/// Moves y to the target, or to the first bound on the way, which then holds that component. True
/// if the target was reached.
bool BoundedStep::move_towards(const Eigen::VectorXd& target, const std::vector<Index>& free,
                               std::vector<AtBound>* places, Eigen::VectorXd* y) const {
  double fraction = 1.0;
  Index blocking = -1;
  for (const Index i : free) {
    const double d = target[i] - (*y)[i], bound = d < 0.0 ? lower_[i] : upper_[i];
    if (!(d < 0.0 ? target[i] < bound : target[i] > bound)) continue;
    const double reach = std::max(0.0, (bound - (*y)[i]) / d);
    if (reach >= fraction) continue;
    fraction = reach;
    blocking = i;
  }
  if (blocking < 0) {
    *y = target;
    return true;
  }
  const bool down = target[blocking] < (*y)[blocking];
  *y += fraction * (target - *y);
  (*y)[blocking] = down ? lower_[blocking] : upper_[blocking];
  (*places)[to_index(blocking)] = down ? AtBound::kLower : AtBound::kUpper;
  return false;
}

/// Frees the component that gains most by leaving its bound. False if none gains.
bool BoundedStep::release(double mu, const Eigen::VectorXd& y, std::vector<AtBound>* places) const {
  const Eigen::VectorXd slope = gradient_ + 2.0 * (root_.transpose() * (root_ * y) + mu * y);
  double most = kRounding * gradient_.cwiseAbs().maxCoeff();
  std::size_t best = places->size();
  for (std::size_t k = 0; k < places->size(); ++k) {
    const double by_inside = slope[static_cast<Index>(k)];
    const double gain = (*places)[k] == AtBound::kLower   ? -by_inside
                        : (*places)[k] == AtBound::kUpper ? by_inside
                                                          : 0.0;
    if (gain <= most) continue;
    most = gain;
    best = k;
  }
  if (best == places->size()) return false;
  (*places)[best] = AtBound::kFree;
  return true;
}

Eigen::VectorXd BoundedStep::unscaled(const Eigen::VectorXd& y,
                                      const std::vector<AtBound>& places) const {
  Eigen::VectorXd p = y.cwiseQuotient(scale_).cwiseMax(step_lower_).cwiseMin(step_upper_);
  for (std::size_t k = 0; k < places.size(); ++k) {
    const auto i = static_cast<Index>(k);
    if (places[k] == AtBound::kLower) p[i] = step_lower_[i];
    if (places[k] == AtBound::kUpper) p[i] = step_upper_[i];
  }
  return p;
}

// Bisection of the logarithm of mu, since the damping may be of any magnitude. |y| is at most |g| /
// (2 mu), and falls as mu grows.
Eigen::VectorXd BoundedStep::within(double radius) const {
  Eigen::VectorXd p = damped(kLeastDamping);
  if (length(p) <= 1.1 * radius) return p;
  double low = std::log(kLeastDamping), high = std::log(0.5 * gradient_.norm() / radius);
  p = damped(std::exp(high));
  for (int k = 0; k < kMostBisections && length(p) < 0.9 * radius; ++k) {
    const double middle = 0.5 * (low + high);
    const Eigen::VectorXd tried = damped(std::exp(middle));
    const bool too_long = length(tried) > 1.1 * radius;
    (too_long ? low : high) = middle;
    if (!too_long) p = tried;
  }
  return p;
}

double BoundedStep::predicted_decrease(const Eigen::VectorXd& p) const {
  const Eigen::VectorXd y = scale_.cwiseProduct(p);
  return -(gradient_.dot(y) + (root_ * y).squaredNorm());
}

}  // namespace codesign
