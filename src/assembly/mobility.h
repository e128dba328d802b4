// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <vector>

#include "assembly/assembly.h"

namespace codesign {

/// Dimension of the set of real solutions y of the quadratic equations y^T H_k y = 0; of several branches, the largest dimension found.
/// @param forms the symmetric matrices H_k, all of the size of y.
int dimension_of_cone(const std::vector<Eigen::MatrixXd>& forms);

/// At a singular position (a stretched-out or flat linkage) the null space of Phi_q contains velocities that belong to no motion, because
/// the second derivatives of the constraints forbid them; doc/theory.md (23a).
/// @returns the dimension of the null space minus the dimension of the motions; 0 at a regular position.
/// @param assembly its last positions are used. @param equations must hold the design at `parameters`.
int motions_lost_to_curvature(const std::vector<double>& parameters, const Assembly& assembly, const Equations<double>& equations);

}  // namespace codesign
