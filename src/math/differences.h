// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <limits>

namespace codesign {

/// The largest difference between the entries of a Jacobian J and of its reference R.
struct JacobianDifference {
  /// |J - R| / (1 + |R|); infinite if an entry is NaN, 1e300 if the sizes differ
  double largest = 0.0;
  /// of that entry; -1 if all entries agree or the sizes differ
  Eigen::Index row = -1, column = -1;
};

/// Compares a Jacobian with its reference of the same size, entry by entry.
inline JacobianDifference compare_jacobians(const Eigen::MatrixXd& jacobian,
                                            const Eigen::MatrixXd& reference) {
  JacobianDifference difference;
  if (jacobian.rows() != reference.rows() || jacobian.cols() != reference.cols())
    return {1e300, -1, -1};
  for (Eigen::Index c = 0; c < reference.cols(); ++c) {
    for (Eigen::Index r = 0; r < reference.rows(); ++r) {
      const double d =
          std::abs(jacobian(r, c) - reference(r, c)) / (1.0 + std::abs(reference(r, c)));
      // Every comparison with NaN is false, so the test below would let it pass.
      if (std::isnan(d)) return {std::numeric_limits<double>::infinity(), r, c};
      if (d > difference.largest) difference = {d, r, c};
    }
  }
  return difference;
}

/// Jacobian of f at x by the complex step, exact to rounding for an analytic f: R^n -> R^m.
/// @param f callable on Eigen::VectorXcd (n), returning Eigen::VectorXcd (m). @return m x n; empty
/// if n is 0.
template <class Function>
Eigen::MatrixXd complex_step_jacobian(const Function& f, const Eigen::VectorXd& x) {
  constexpr double kStep = 1e-30;
  Eigen::VectorXcd z = x.cast<std::complex<double>>();
  Eigen::MatrixXd jacobian;
  for (Eigen::Index c = 0; c < x.size(); ++c) {
    z[c] += std::complex<double>(0.0, kStep);
    const Eigen::VectorXcd value = f(z);
    if (jacobian.size() == 0) jacobian.resize(value.size(), x.size());
    jacobian.col(c) = value.imag() / kStep;
    z[c] = x[c];
  }
  return jacobian;
}

/// A derivative with an estimate of its absolute error.
struct RiddersDerivative {
  double value = 0.0;
  /// the change by the last extrapolation, or the difference of the last quotient if these do not
  /// approach it; infinite if f was never finite
  double error = std::numeric_limits<double>::infinity();
};

/// Derivative of f at x by central differences extrapolated to step zero (Ridders, doc/theory.md
/// [9]). Six steps, two calls of f each.
/// @param step the first step; each further one is half as long.
template <class Function>
RiddersDerivative ridders_derivative(const Function& f, double x, double step) {
  constexpr int kLevels = 6;
  constexpr double kShrink = 2.0;
  std::array<std::array<double, kLevels>, kLevels> table{};
  RiddersDerivative best;
  double h = step;
  for (std::size_t i = 0; i < kLevels; ++i, h /= kShrink) {
    table[0][i] = (f(x + h) - f(x - h)) / (2.0 * h);
    double factor = kShrink * kShrink;
    for (std::size_t j = 1; j <= i; ++j, factor *= kShrink * kShrink) {
      table[j][i] = (factor * table[j - 1][i] - table[j - 1][i - 1]) / (factor - 1.0);
      const double error = std::max(std::abs(table[j][i] - table[j - 1][i]),
                                    std::abs(table[j][i] - table[j - 1][i - 1]));
      if (error <= best.error) best = {table[j][i], error};
    }
  }
  // Of a smooth f, the plain quotients approach the derivative; beside a singular point two
  // extrapolations may agree by accident.
  const double last = std::abs(table[0][kLevels - 1] - best.value),
               before = std::abs(table[0][kLevels - 2] - best.value);
  if (!(last <= 0.5 * before)) best.error = std::max(best.error, last);
  return best;
}

}  // namespace codesign
