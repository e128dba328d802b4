// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <vector>

#include "assembly/assembly.h"
#include "equations/compiled_system.h"
#include "mechanism_codesign/counts.h"
#include "mechanism_codesign/status.h"

namespace codesign {

/// Dimension of the set of real solutions y of the quadratic equations y^T H_k y = 0; of several
/// branches, the largest dimension found.
/// @param forms the symmetric matrices H_k, all of the size of y.
int dimension_of_cone(const std::vector<Eigen::MatrixXd>& forms);

/// At a singular position (a stretched-out or flat linkage) the null space of Phi_q contains
/// velocities that belong to no motion, because the second derivatives of the constraints forbid
/// them; doc/theory.md (23a).
/// @returns the dimension of the null space minus the dimension of the motions; 0 at a regular
/// position.
/// @param assembly its last positions are used. @param equations must hold the design at
/// `parameters`.
int motions_lost_to_curvature(const std::vector<double>& parameters, const Assembly& assembly,
                              const Equations<double>& equations);

/// Counts coordinates, constraints and equations at the assembled initial state, as in the paper's
/// table "number of equations". Redundant constraints are found by doc/theory.md (23), degrees of
/// freedom by (23a).
/// @param parameters all named parameters (Study::parameters order).
/// @param status receives the status of Assembly::solve(). After kAssemblyFailed the counts that
/// need the rank of Phi_q (redundancy, degrees of freedom) and the sums of equations are zero.
Counts count_equations(const CompiledSystem& system, const std::vector<double>& parameters,
                       Status* status);

}  // namespace codesign
