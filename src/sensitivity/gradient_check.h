// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <atomic>
#include <memory>
#include <vector>

#include "mechanism_codesign/gradient.h"

namespace codesign {

class CompiledSystem;
struct MotionStudy;

/// Evaluates the study of a compiled system.
Evaluator evaluator_of(std::shared_ptr<const CompiledSystem> system);

/// check_gradient() of a compiled system.
GradientCheck check_gradient(const std::shared_ptr<const CompiledSystem>& system,
                             const Eigen::VectorXd& rho, CheckMethod method,
                             const std::atomic<bool>* cancel = nullptr);

/// check_gradient() at values of all named parameters, in the order of Study::parameters.
/// @param directions becomes GradientCheck::directions; empty: the reference is the derivative by
/// each parameter.
GradientCheck check_design(const std::shared_ptr<const CompiledSystem>& system,
                           const std::vector<double>& parameters, CheckMethod method,
                           const std::atomic<bool>* cancel = nullptr,
                           const Eigen::MatrixXd& directions = {});

/// Whether a run of the study can be repeated with the same steps in complex arithmetic.
bool can_replay(const MotionStudy& study);

/// The derivatives of psi along `directions` (empty: by each tuned parameter) through the steps of
/// a run with a hundredth of the study's tolerances.
Status differentiate_finer_steps(const CompiledSystem& system,
                                 const std::vector<double>& parameters,
                                 const Eigen::MatrixXd& directions, const std::atomic<bool>* cancel,
                                 Eigen::VectorXd* derivatives);

/// `count` pseudo-random directions, always the same ones, along which each parameter changes the
/// objective by a similar amount, with either sign; a parameter with a component below a thousandth
/// of the largest counts as if it had that. So at least a third of a relative error of one
/// component of the gradient shows.
Eigen::MatrixXd check_directions(const Eigen::VectorXd& gradient, int count);

/// Sets GradientCheck::largest_relative_difference from the gradient and its reference, and
/// GradientCheck::largest_change.
void compare(GradientCheck* check);

}  // namespace codesign
