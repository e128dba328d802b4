// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <array>
#include <string>
#include <vector>

namespace codesign {

/// The ten numbers of a body in which efforts are linear: mass [kg], mass times centre [kg m] and
/// the moments and products of inertia about the origin of its link [kg m^2]. Their names follow
/// the name of the link: LINK_m and so on.
inline constexpr std::array<const char*, 10> kInertialNames{"m",   "mx",  "my",  "mz",  "Jxx",
                                                            "Jyy", "Jzz", "Jxy", "Jyz", "Jxz"};

/// These numbers of a free inertia (28e), and their derivatives (rows) by its ten numbers in the
/// order of kLogCholeskyNames (columns).
struct InertialNumbers {
  Eigen::Matrix<double, 10, 1> values;
  Eigen::Matrix<double, 10, 10> derivatives;
};
InertialNumbers inertial_numbers(const Eigen::Matrix<double, 10, 1>& log_cholesky);

/// U of (28e) of these ten numbers, upper triangular.
Eigen::Matrix4d cholesky_factor(const Eigen::Matrix<double, 10, 1>& log_cholesky);
/// Its derivative by number k.
Eigen::Matrix4d cholesky_slope(const Eigen::Matrix<double, 10, 1>& log_cholesky, int k);

/// Numbers of a fit and the derivatives of residuals by them.
struct LinearNumbers {
  std::vector<std::string> names;
  Eigen::VectorXd x;
  Eigen::MatrixXd jacobian;
  bool is_changed = false;  ///< whether there is a free inertia
};

/// The same fit with each whole free inertia among `names` in the numbers in which efforts are
/// linear.
LinearNumbers with_inertial_numbers(const std::vector<std::string>& names, const Eigen::VectorXd& x,
                                    const Eigen::MatrixXd& jacobian);

}  // namespace codesign
