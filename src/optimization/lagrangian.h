// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <atomic>

#include "ensemble/parameter_rows.h"
#include "optimization/scaling.h"
#include "optimization/smooth_program.h"

namespace codesign {

/// Writes the derivatives of a number by the optimizer's variables: the scaled parameters, then the slack variables.
void spread(const SmoothProgram::Value& value, const Scaling& scaling, double* by_x);

/// The optimality conditions of a design in the smooth form of the problem, doc/theory.md (24j).
struct Optimality {
  double slope = 0.0;      ///< residual of the conditions, in the unit of psi; 0 at an optimum
  Eigen::VectorXd bounds;  ///< multipliers of the bounds of the scaled parameters: positive at the lower one, negative at the upper one
  Eigen::MatrixXd active;  ///< gradients by the scaled parameters of the rows with a multiplier, one per column
  int factorizations = 0;  ///< of matrices of the variables, as a measure of the work
};

/// With the multipliers, of the sign that their rows require, which make the residual least. @param at the evaluation of the design.
/// @param cancel ends the search for these multipliers, after which the slope is too large; may be null.
Optimality optimality(const EnsembleEvaluation& at, const Eigen::VectorXd& rho, const Scaling& scaling, const ParameterRows& parameters,
                      SmoothProgram* program, const std::atomic<bool>* cancel = nullptr);

}  // namespace codesign
