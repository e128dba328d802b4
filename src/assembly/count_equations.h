// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "equations/compiled_system.h"
#include "mechanism_codesign/counts.h"
#include "mechanism_codesign/status.h"

namespace codesign {

/// Counts coordinates, constraints and equations at the assembled initial state, as in the paper's table "number of equations". Redundant
/// constraints are found by doc/theory.md (23), degrees of freedom by (23a).
/// @param parameters all named parameters (Study::parameters order).
/// @param status receives the status of Assembly::solve(). After kAssemblyFailed the counts that need the rank of Phi_q (redundancy,
/// degrees of freedom) and the sums of equations are zero.
Counts count_equations(const CompiledSystem& system, const std::vector<double>& parameters, Status* status);

}  // namespace codesign
