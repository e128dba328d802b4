// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "excitation/excited_motion.h"
#include "identification/effort/effort_tangent.h"
#include "identification/fit/fit_variables.h"

namespace codesign {

/// The information of recorded efforts along a motion about the unknowns of an identification,
/// FitVariables, at their start values; doc/theory.md (46). Efforts have white noise, independent
/// from joint to joint.
class Information {
 public:
  /// @param variables must outlive this. @param joints names of joints. @param noise of each joint:
  /// standard deviation of one sample [N m or N].
  Information(const FitVariables& variables, std::vector<std::string> joints,
              Eigen::VectorXd noise);

  const FitVariables& variables() const { return variables_; }
  /// The Jacobian of all residuals, each divided by its standard deviation; row joint * samples +
  /// sample.
  /// @param response with a Jacobian. @param step time between samples [s].
  Eigen::MatrixXd jacobian(const PathResponse& response, double step) const;

  /// Derivatives of a number by the entries of a response.
  struct ByResponse {
    RowJacobian jacobian;    ///< as PathResponse::jacobian
    Eigen::MatrixXd effort;  ///< joints x samples
  };
  /// The derivatives of a number by a response, from its derivatives by the entries of jacobian().
  ByResponse by_response(const Eigen::MatrixXd& by_jacobian, Eigen::Index samples,
                         double step) const;

 private:
  const FitVariables& variables_;
  const std::vector<std::string> joints_;
  const Eigen::VectorXd noise_;
};

/// The negative logarithm of the determinant of the information matrix J^T J of some columns,
/// (46a): twice the logarithm of the volume of the confidence ellipsoid, up to a constant. Infinite
/// if these columns depend on each other.
/// @param columns of J. @param by_jacobian may be null; else receives the derivatives by all
/// entries of J.
double information_criterion(const Eigen::MatrixXd& J, const std::vector<int>& columns,
                             Eigen::MatrixXd* by_jacobian);

}  // namespace codesign
