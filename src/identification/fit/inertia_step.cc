// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "identification/fit/inertia_step.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "math/arrays.h"
#include "math/dense.h"

namespace codesign {
namespace {

constexpr double kFall = 0.1;       // of the weights, from one minimum of the path to the next
constexpr double kOnPath = 0.1;     // of a weight: near enough to a minimum of the path
constexpr double kAtEnd = 1e-10;    // of a weight: near enough to the last minimum
constexpr double kFree = 1e-12;     // damping of directions without effect, of the squared columns
constexpr double kToBorder = 0.99;  // of the way to the border: the longest step
constexpr int kMostSteps = 60;      // of Newton's method, and of bisections

/// E = K K^T, K lower triangular.
Eigen::Matrix4d lower_root(const Eigen::Matrix4d& E) {
  Eigen::Matrix4d K = Eigen::Matrix4d::Zero();
  for (int j = 0; j < 4; ++j)
    for (int i = j; i < 4; ++i) {
      double left = E(i, j);
      for (int k = 0; k < j; ++k) left -= K(i, k) * K(j, k);
      K(i, j) = i == j ? std::sqrt(left) : left / K(j, j);
    }
  return K;
}

Eigen::Matrix4d lower_inverse(const Eigen::Matrix4d& E) {
  const Eigen::Matrix4d K = lower_root(E);
  Eigen::Matrix4d inverse = Eigen::Matrix4d::Zero();
  for (int column = 0; column < 4; ++column)
    for (int row = column; row < 4; ++row) {
      double left = row == column ? 1.0 : 0.0;
      for (int k = column; k < row; ++k) left -= K(row, k) * inverse(k, column);
      inverse(row, column) = left / K(row, row);
    }
  return inverse;
}

/// The eigenvalues of K^-1 S K^-T: ln det(E + t S) = ln det E + sum ln(1 + t value).
Eigen::Vector4d relative_values(const Eigen::Matrix4d& E, const Eigen::Matrix4d& S) {
  const Eigen::Matrix4d inverse = lower_inverse(E);
  return symmetric_eigen(inverse * S * inverse.transpose()).values;
}

}  // namespace

InertiaStep::InertiaStep(const Eigen::VectorXd& gradient, const Eigen::MatrixXd& root,
                         const std::vector<InertiaBlock>& blocks, const Eigen::VectorXd& lower,
                         const Eigen::VectorXd& upper)
    : gradient_(gradient),
      root_(root),
      blocks_(blocks),
      lower_(lower),
      upper_(upper),
      places_(to_index(gradient.size()), AtBound::kFree),
      p_(Eigen::VectorXd::Zero(gradient.size())) {
  for (const InertiaBlock& block : blocks) matrices_.push_back(block.matrix);
  for (std::size_t k = 0; k < places_.size(); ++k) {
    const auto i = to_signed(k);
    if (lower_[i] == 0.0 && gradient_[i] >= 0.0) places_[k] = AtBound::kLower;
    if (upper_[i] == 0.0 && gradient_[i] <= 0.0) places_[k] = AtBound::kUpper;
  }
  follow();
}

// The path begins where its minimum is about as far off as Newton's model tells.
void InertiaStep::follow() {
  double largest = 1.0;
  if (!blocks_.empty()) {
    const double order = 4.0 * static_cast<double>(blocks_.size());
    const double far = newton(1.0, slope(1.0)).decrease / (order * blocks_.front().weight);
    if (std::isfinite(far)) largest = std::max(1.0, far);
  }
  while (largest > 1.0) {
    minimize(largest, kOnPath);
    largest *= kFall;
  }
  minimize(1.0, kAtEnd);
}

void InertiaStep::minimize(double factor, double enough) {
  const double weight = blocks_.empty() ? 0.0 : factor * blocks_.front().weight;
  double before = std::numeric_limits<double>::infinity();
  for (int k = 0; k < kMostSteps + 2 * static_cast<int>(places_.size()); ++k) {
    const Eigen::VectorXd down = slope(factor);
    const Direction direction = newton(factor, down);
    // Where rounding holds Newton's method, its predictions stay as they are.
    const bool is_near = !(direction.decrease > enough * weight) ||
                         (direction.decrease < weight && direction.decrease > 0.5 * before);
    before = direction.decrease;
    if (is_near) {
      if (!release(down)) return;
      before = std::numeric_limits<double>::infinity();
      continue;
    }
    if (!advance(direction, factor)) before = std::numeric_limits<double>::infinity();
  }
}

Eigen::VectorXd InertiaStep::slope(double factor) const {
  Eigen::VectorXd result = gradient_ + 2.0 * (root_.transpose() * (root_ * p_));
  for (std::size_t l = 0; l < blocks_.size(); ++l) {
    const Eigen::Matrix4d inverse = lower_inverse(matrices_[l]);
    const SymmetricNumbers by_matrix =
        factor * blocks_[l].weight *
        symmetric_numbers(Eigen::Matrix4d::Identity() - inverse.transpose() * inverse);
    for (std::size_t k = 0; k < blocks_[l].columns.size(); ++k)
      result[blocks_[l].columns[k]] += by_matrix[to_signed(k)];
  }
  return result;
}

// The rows of a block have the sum of squares tr((E^-1 S)^2) / 2.
InertiaStep::Direction InertiaStep::newton(double factor, const Eigen::VectorXd& slope) const {
  std::vector<Eigen::Index> free;
  for (std::size_t k = 0; k < places_.size(); ++k)
    if (places_[k] == AtBound::kFree) free.push_back(to_signed(k));
  const Eigen::Index rows = root_.rows(), columns = slope.size(),
                     blocks = to_signed(blocks_.size());
  Eigen::MatrixXd all = Eigen::MatrixXd::Zero(rows + 10 * blocks + columns, columns);
  all.topRows(rows) = root_;
  const Eigen::VectorXd norms = root_.colwise().norm();
  all.bottomRows(columns).diagonal() =
      std::sqrt(kFree) * norms.cwiseMax(norms.maxCoeff() > 0.0 ? 1e-8 * norms.maxCoeff() : 1.0);
  for (Eigen::Index l = 0; l < blocks; ++l) {
    const InertiaBlock& block = blocks_[to_index(l)];
    const Eigen::Matrix4d inverse = lower_inverse(matrices_[to_index(l)]);
    for (int k = 0; k < 10; ++k) {
      const int column = block.columns[to_index(k)];
      all(rows + 10 * blocks + column, column) = 0.0;
      all.col(column).segment<10>(rows + 10 * l) =
          std::sqrt(0.5 * factor * block.weight) *
          symmetric_numbers(inverse * symmetric_matrix(SymmetricNumbers::Unit(k)) *
                            inverse.transpose());
    }
  }
  Direction result{Eigen::VectorXd::Zero(columns), 0.0};
  if (free.empty()) return result;
  const Eigen::MatrixXd stacked = all(Eigen::all, free);
  const Eigen::MatrixXd R = triangular_root(stacked);
  const auto solve = [&R](Eigen::VectorXd b) {
    R.triangularView<Eigen::Upper>().transpose().solveInPlace(b);
    R.triangularView<Eigen::Upper>().solveInPlace(b);
    return b;
  };
  const Eigen::VectorXd right = -0.5 * Eigen::VectorXd(slope(free));
  Eigen::VectorXd s = solve(right);
  s += solve(right - stacked.transpose() * (stacked * s));
  result.s(free) = s;
  result.decrease = -0.5 * slope.dot(result.s);
  return result;
}

// The slope of the convex function of the length changes its sign at the minimum.
double InertiaStep::length_along(const Eigen::VectorXd& s, double factor, double most) const {
  const Eigen::VectorXd image = root_ * s;
  const double first = gradient_.dot(s) + 2.0 * (root_ * p_).dot(image),
               second = 2.0 * image.squaredNorm();
  std::vector<Eigen::Vector4d> values;
  double border = std::numeric_limits<double>::infinity();
  for (std::size_t l = 0; l < blocks_.size(); ++l) {
    const SymmetricNumbers part = s(blocks_[l].columns);
    values.push_back(relative_values(matrices_[l], symmetric_matrix(part)));
    if (values.back().minCoeff() < 0.0) border = std::min(border, -1.0 / values.back().minCoeff());
  }
  const auto slope_at = [&](double t) {
    double sum = first + second * t;
    for (std::size_t l = 0; l < blocks_.size(); ++l)
      sum += factor * blocks_[l].weight *
             (s(blocks_[l].columns).head<4>().sum() -
              (values[l].array() / (1.0 + t * values[l].array())).sum());
    return sum;
  };
  double low = 0.0, high = std::min(most, kToBorder * border);
  if (slope_at(high) <= 0.0) return high;
  for (int k = 0; k < kMostSteps; ++k) {
    const double middle = 0.5 * (low + high);
    (slope_at(middle) > 0.0 ? high : low) = middle;
  }
  return low;
}

/// Moves along a direction to the minimum, or to the first bound on the way, which then holds that
/// component. False in the second case.
bool InertiaStep::advance(const Direction& direction, double factor) {
  constexpr double kLongest = 4.0;  // times the step of Newton's model
  double most = kLongest;
  Eigen::Index blocking = -1;
  for (Eigen::Index i = 0; i < p_.size(); ++i) {
    const double d = direction.s[i], bound = d < 0.0 ? lower_[i] : upper_[i];
    if (d == 0.0 || !std::isfinite(bound)) continue;
    const double reach = std::max(0.0, (bound - p_[i]) / d);
    if (reach >= most) continue;
    most = reach;
    blocking = i;
  }
  const double t = most > 0.0 ? length_along(direction.s, factor, most) : 0.0;
  p_ += t * direction.s;
  for (std::size_t l = 0; l < blocks_.size(); ++l)
    matrices_[l] = blocks_[l].matrix + symmetric_matrix(SymmetricNumbers(p_(blocks_[l].columns)));
  if (blocking < 0 || t < most) return true;
  const bool is_down = direction.s[blocking] < 0.0;
  p_[blocking] = is_down ? lower_[blocking] : upper_[blocking];
  places_[to_index(blocking)] = is_down ? AtBound::kLower : AtBound::kUpper;
  return false;
}

/// Frees the component that gains most by leaving its bound. False if none gains.
bool InertiaStep::release(const Eigen::VectorXd& slope) {
  constexpr double kRounding = 1e-10;  // of the terms of a slope
  const double image = 2.0 * (root_ * p_).norm();
  double most = 0.0;
  std::size_t best = places_.size();
  for (std::size_t k = 0; k < places_.size(); ++k) {
    const auto i = to_signed(k);
    if (places_[k] == AtBound::kFree || lower_[i] == upper_[i]) continue;
    const double gain = (places_[k] == AtBound::kLower ? -slope[i] : slope[i]) /
                        std::max(std::abs(gradient_[i]) + root_.col(i).norm() * image, 1e-300);
    if (gain <= std::max(most, kRounding)) continue;
    most = gain;
    best = k;
  }
  if (best == places_.size()) return false;
  places_[best] = AtBound::kFree;
  return true;
}

double InertiaStep::decrease() const {
  double sum = -(gradient_.dot(p_) + (root_ * p_).squaredNorm());
  for (std::size_t l = 0; l < blocks_.size(); ++l) {
    const SymmetricNumbers part = p_(blocks_[l].columns);
    const Eigen::Vector4d values = relative_values(blocks_[l].matrix, symmetric_matrix(part));
    sum -= blocks_[l].weight * (part.head<4>().sum() - values.array().log1p().sum());
  }
  return sum;
}

}  // namespace codesign
