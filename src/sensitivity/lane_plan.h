// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_SENSITIVITY_LANE_PLAN_H_
#define MECHANISM_CODESIGN_SENSITIVITY_LANE_PLAN_H_

#include <atomic>
#include <vector>

#include "equations/equations.h"

namespace codesign {

/// Which tuned parameters share a lane: those that no row of the equations has in common, so that each row's derivative along the lane is
/// that by one parameter (Curtis, Powell and Reid's compression); doc/theory.md (18d).
struct LanePlan {
  std::vector<std::vector<int>> rows;  ///< per parameter, ascending: the rows that depend on it, the integrand's last
  std::vector<int> lane;               ///< per parameter
  int lanes = 0;
};

/// Rows of G, g, Phi and Phi_q v (at the place of their acceleration rows) that depend on each tuned parameter, and those of G's and g's
/// derivatives. Found with NaN for the parameters' directions, which nothing cancels or multiplies away: what stays a number does not
/// depend on them.
/// @param cancel if given and set, the rest of the parameters has no rows.
std::vector<std::vector<int>> dependent_rows(const CompiledSystem& system, const std::vector<double>& parameters, const State<double>& at,
                                             const std::atomic<bool>* cancel = nullptr);

/// Greedy colouring, the parameters with most rows first.
LanePlan plan_lanes(std::vector<std::vector<int>> rows);

/// Every parameter in a lane of its own, whatever its rows: always right.
LanePlan unshared_lanes(const CompiledSystem& system);

/// For a system at its start values; a parameter's rows are the same for every design.
/// @param cancel if given and set, it ends soon, with a plan that is good for nothing.
LanePlan plan_lanes(const CompiledSystem& system, const std::atomic<bool>* cancel = nullptr);

}  // namespace codesign

#endif  // MECHANISM_CODESIGN_SENSITIVITY_LANE_PLAN_H_
