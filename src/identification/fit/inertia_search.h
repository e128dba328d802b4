// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <vector>

#include "identification/fit/fit_prior.h"
#include "optimization/levenberg_marquardt.h"

namespace codesign {

/// The inertias of a prior whose ten numbers have no bounds and no other prior.
std::vector<InertiaPrior> unbounded_inertias(const FitPrior& prior, const Eigen::VectorXd& lower,
                                             const Eigen::VectorXd& upper);

/// Minimizes a sum of squares psi and the priors of free inertias within bounds, doc/theory.md
/// (39d); unknowns of the model's own count by LeastSquaresPoint::inner_decrease. Residuals that
/// are linear in the inertial numbers, as efforts are, need one step, however near to the border of
/// the possible inertias the minimum lies: each step solves the convex problem (InertiaStep) that
/// is exact in these numbers and linearized in the others. Where a step fails to gain what it
/// predicts, the next one is damped as by Levenberg and Marquardt.
///
/// The end is judged by the same convex problem without damping: it predicts a decrease below
/// `relative_tolerance` (kValueTolerance) or below rounding (kOptimum), which at a minimum on the
/// border as elsewhere are the conditions of optimality of the semidefinite problem.
/// @param inertias priors of unbounded_inertias(), at least one, all with the same weight
/// @param model its value includes these priors, its gradient and root do not. @param x the start,
/// within the bounds; receives the best point.
LevenbergMarquardtEnd minimize_with_inertias(const LevenbergMarquardtOptions& options,
                                             const Eigen::VectorXd& lower,
                                             const Eigen::VectorXd& upper,
                                             const std::vector<InertiaPrior>& inertias,
                                             LeastSquaresModel* model, Eigen::VectorXd* x);

}  // namespace codesign
