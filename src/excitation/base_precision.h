// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "identification/fit/fit_variables.h"

namespace codesign {

/// How well a recording is expected to tell the base parameters: the combinations (32) that
/// trajectories determine, of free inertias by the numbers in which efforts are linear.
class BasePrecision {
 public:
  BasePrecision() = default;
  /// @param variables must outlive this. @param stacked the Jacobian of several trajectories, or a
  /// factor R of it
  BasePrecision(const FitVariables& variables, const Eigen::MatrixXd& stacked);

  /// Names of the base parameters.
  const std::vector<std::string>& names() const { return names_; }
  /// Whether some are no numbers of the identification themselves.
  bool has_combinations() const { return has_combinations_; }

  struct Merit {
    /// of the Jacobian by the base parameters, residuals over the noise and numbers in SI units;
    /// infinite if the trajectory does not determine all
    double condition = 0.0;
    Eigen::VectorXd deviations;  ///< of the base parameters
  };
  /// @param J of one trajectory
  Merit of(const Eigen::MatrixXd& J) const;

 private:
  const FitVariables* variables_ = nullptr;
  std::vector<int> columns_;
  std::vector<std::string> names_;
  bool has_combinations_ = false;
};

}  // namespace codesign
