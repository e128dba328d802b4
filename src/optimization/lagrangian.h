// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_OPTIMIZATION_LAGRANGIAN_H_
#define MECHANISM_CODESIGN_OPTIMIZATION_LAGRANGIAN_H_

#include "optimization/scaling.h"
#include "optimization/smooth_program.h"

namespace codesign {

/// Writes the derivatives of a number by the optimizer's variables: the scaled parameters, then the slack variables.
void spread(const SmoothProgram::Value& value, const Scaling& scaling, double* by_x);

/// Norm of the gradient of the Lagrangian at a design by the optimizer's variables, with the multipliers of the active rows and bounds that
/// make it least; zero at an optimum. @param at the evaluation of the design. @param unit of the scaled objective.
double lagrangian_residual(const EnsembleEvaluation& at, const Eigen::VectorXd& rho, const Scaling& scaling, double unit,
                           SmoothProgram* program);

}  // namespace codesign

#endif  // MECHANISM_CODESIGN_OPTIMIZATION_LAGRANGIAN_H_
