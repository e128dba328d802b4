// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <atomic>
#include <vector>

#include "mechanism_codesign/status.h"

namespace codesign {

class CompiledSystem;

/// Adds to a reference for a gradient what the numbers of a linearization contribute, theory (70):
/// Ridders' differences of their values, which share nothing with their derivatives. Nothing for a
/// study without such numbers.
/// @param directions one column each. @param objective, error derivatives of psi along them so far,
/// and the estimates of their errors. @param watched one row per direction and one column per
/// number of WatchLayout; resized where it has none.
Status add_linear_differences(const CompiledSystem& system, const std::vector<double>& parameters,
                              const Eigen::MatrixXd& directions, const std::atomic<bool>* cancel,
                              Eigen::VectorXd* objective, Eigen::VectorXd* error,
                              Eigen::MatrixXd* watched);

}  // namespace codesign
