// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "equations/compiled_system.h"
#include "system/state.h"

namespace codesign {

/// Independent coordinates y of a mechanism at a state, theory (67): dq = Q dy and, along the
/// constraints, dv = Q dy' + P dy. y are entries of q, of the joints that the study starts where
/// this is possible.
struct LinearCoordinates {
  std::vector<int> columns;  ///< in q, of y
  Eigen::MatrixXd Q, P;      ///< n rows, one column per coordinate
};
/// @param derivatives of the equations at the state.
LinearCoordinates linear_coordinates(const CompiledSystem& system,
                                     const Linearization<double>& derivatives,
                                     const State<double>& state);

/// The names of y and y', `JOINT/position` and `JOINT/velocity`, and of the extra states s:
/// `CONTROLLER/integral`, `CONTROLLER/held`, ..., `JOINT/bristle[k]`.
std::vector<std::string> linear_state_names(const CompiledSystem& system,
                                            const std::vector<int>& columns);

/// The rows of Phi_q that are enforced; the others are zero.
Eigen::MatrixXd constraint_rows(const CompiledSystem& system,
                                const Linearization<double>& derivatives);

}  // namespace codesign
