// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_ASSEMBLY_MOBILITY_H_
#define MECHANISM_CODESIGN_ASSEMBLY_MOBILITY_H_

#include <Eigen/Core>
#include <vector>

#include "assembly/assembly.h"

namespace codesign {

/// Dimension of the real solutions y of the quadratic equations y^T H_k y = 0, the largest of those of the branches that are found.
/// @param forms symmetric k x k matrices.
int dimension_of_cone(const std::vector<Eigen::MatrixXd>& forms);

/// At a singular position (a stretched-out or flat linkage) the null space of Phi_q holds velocities that are no motion: the constraints'
/// second derivatives forbid them; doc/theory.md (23a). @returns by how many dimensions the motions fall short of the null space, 0 where
/// the position is regular.
/// @param assembly as it found the position; `equations` hold the design at `parameters`.
int motions_lost_to_curvature(const std::vector<double>& parameters, const Assembly& assembly, const Equations<double>& equations);

}  // namespace codesign

#endif  // MECHANISM_CODESIGN_ASSEMBLY_MOBILITY_H_
