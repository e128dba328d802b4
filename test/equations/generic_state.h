// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>

#include "assembly/determined_motion.h"
#include "equations/compiled.h"
#include "math/dense.h"

namespace codesign {

/// Numbers between -1 and 1, the same in every run.
Eigen::VectorXd waves(Eigen::Index size, double phase);

Eigen::MatrixXd pseudo_inverse(const Eigen::MatrixXd& matrix);

/// The part of a velocity that the constraints allow.
Eigen::VectorXd allowed(const Eigen::MatrixXd& Phi_q, const Eigen::VectorXd& v);

/// Moves a started mechanism to a generic position with generic velocities, and solves for its
/// accelerations and multipliers. False if the constraints cannot be satisfied there.
bool scramble(Compiled* c, double amount = 0.4);

}  // namespace codesign
