// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "identification/fit/inertial_numbers.h"

#include <cmath>

#include "identification/fit/fit_variables.h"
#include "math/arrays.h"
#include "math/dense.h"
#include "statistics/identifiability.h"

namespace codesign {
namespace {

using Ten = Eigen::Matrix<double, 10, 1>;

/// The ten numbers, in the order of kInertialNames, of a pseudo-inertia; linear in it.
Ten numbers_of(const Eigen::Matrix4d& P) {
  Ten numbers;
  numbers << P(3, 3), P(0, 3), P(1, 3), P(2, 3), P(1, 1) + P(2, 2), P(0, 0) + P(2, 2),
      P(0, 0) + P(1, 1), -P(0, 1), -P(1, 2), -P(0, 2);
  return numbers;
}

}  // namespace

Eigen::Matrix4d cholesky_factor(const Eigen::Matrix<double, 10, 1>& x) {
  Eigen::Matrix4d U = Eigen::Matrix4d::Identity();
  for (int i = 0; i < 3; ++i) U(i, i) = std::exp(x[1 + i]);
  U(0, 1) = x[4];
  U(1, 2) = x[5];
  U(0, 2) = x[6];
  U.topRightCorner<3, 1>() = x.tail<3>();
  return std::exp(x[0]) * U;
}

Eigen::Matrix4d cholesky_slope(const Eigen::Matrix<double, 10, 1>& x, int k) {
  if (k == 0) return cholesky_factor(x);
  constexpr int kRows[] = {0, 1, 2, 0, 1, 0, 0, 1, 2}, kColumns[] = {0, 1, 2, 1, 2, 2, 3, 3, 3};
  Eigen::Matrix4d slope = Eigen::Matrix4d::Zero();
  slope(kRows[k - 1], kColumns[k - 1]) = std::exp(k <= 3 ? x[0] + x[k] : x[0]);
  return slope;
}

InertialNumbers inertial_numbers(const Eigen::Matrix<double, 10, 1>& log_cholesky) {
  const Eigen::Matrix4d U = cholesky_factor(log_cholesky);
  InertialNumbers result;
  result.values = numbers_of(U * U.transpose());
  for (int k = 0; k < 10; ++k) {
    const Eigen::Matrix4d slope = cholesky_slope(log_cholesky, k);
    result.derivatives.col(k) = numbers_of(slope * U.transpose() + U * slope.transpose());
  }
  return result;
}

LinearNumbers with_inertial_numbers(const std::vector<std::string>& names, const Eigen::VectorXd& x,
                                    const Eigen::MatrixXd& jacobian) {
  LinearNumbers result{names, x, jacobian, false};
  for (const auto& [link, columns] : free_inertias(names)) {
    result.is_changed = true;
    const InertialNumbers numbers = inertial_numbers(Ten(x(columns)));
    const LeastNorm inverse = least_norm(numbers.derivatives.transpose());
    const Eigen::MatrixXd by_numbers =
        inverse.solve(Eigen::MatrixXd(jacobian(Eigen::all, columns).transpose())).transpose();
    for (std::size_t k = 0; k < columns.size(); ++k) {
      const auto column = to_signed(k);
      result.names[to_index(columns[k])] = link + "_" + kInertialNames[k];
      result.x[columns[k]] = numbers.values[column];
      result.jacobian.col(columns[k]) = by_numbers.col(column);
    }
  }
  // Numbers without effect have only the rounding of the inverse.
  if (result.is_changed) clear_rounding(result.x, &result.jacobian);
  return result;
}

}  // namespace codesign
