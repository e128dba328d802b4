// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_SENSITIVITY_GRADIENT_CHECK_H_
#define MECHANISM_CODESIGN_SENSITIVITY_GRADIENT_CHECK_H_

#include "mechanism_codesign/gradient.h"

namespace codesign {

/// check_gradient() at values of all named parameters, in the order of Study::parameters.
GradientCheck check_design(const std::shared_ptr<const CompiledSystem>& system, const std::vector<double>& parameters, CheckMethod method,
                           const std::atomic<bool>* cancel = nullptr);

/// Sets GradientCheck::largest_relative_difference from the gradient and its reference.
void compare(GradientCheck* check);

}  // namespace codesign

#endif  // MECHANISM_CODESIGN_SENSITIVITY_GRADIENT_CHECK_H_
