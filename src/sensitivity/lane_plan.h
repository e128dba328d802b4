// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_SENSITIVITY_LANE_PLAN_H_
#define MECHANISM_CODESIGN_SENSITIVITY_LANE_PLAN_H_

#include <atomic>
#include <vector>

#include "equations/equations.h"

namespace codesign {

/// Assignment of tuned parameters to lanes. Parameters share a lane if no row of the equations depends on two of them, so that the
/// derivative of a row along the lane is the derivative by one parameter (compression by Curtis, Powell and Reid [13]); doc/theory.md
/// (18d).
struct LanePlan {
  std::vector<std::vector<int>> rows;  ///< per parameter, ascending: the rows of G (integrand last) that depend on it
  std::vector<int> lane;               ///< per parameter
  int lanes = 0;
};

/// For each tuned parameter the rows of G and g, or of their derivatives, that depend on it; Phi and Phi_q v count as their acceleration
/// rows. Found by evaluation with NaN as the parameter's derivative: NaN cannot cancel or be multiplied by zero, so a row whose derivative
/// is a number does not depend on the parameter.
/// @param parameters all named parameters. @param at the state of the evaluation.
/// @param cancel if it is set meanwhile, the remaining parameters get no rows.
std::vector<std::vector<int>> dependent_rows(const CompiledSystem& system, const std::vector<double>& parameters, const State<double>& at,
                                             const std::atomic<bool>* cancel = nullptr);

/// Assigns lanes by greedy colouring, beginning with the parameters with most rows.
LanePlan plan_lanes(std::vector<std::vector<int>> rows);

/// A plan with one lane per parameter, which is correct for any dependence.
LanePlan unshared_lanes(const CompiledSystem& system);

/// The plan for a system, from dependent_rows() at its start and, for parameters without rows there, at later times. The rows hold for
/// every design.
/// @param cancel if it is set meanwhile, the function ends soon and the plan must not be used.
LanePlan plan_lanes(const CompiledSystem& system, const std::atomic<bool>* cancel = nullptr);

}  // namespace codesign

#endif  // MECHANISM_CODESIGN_SENSITIVITY_LANE_PLAN_H_
