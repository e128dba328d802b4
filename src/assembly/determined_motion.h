// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/SparseCore>
#include <vector>

#include "assembly/assembly.h"
#include "equations/equations.h"
#include "sparse/least_squares.h"

namespace codesign {

class CompiledSystem;

/// The part of G_z, doc/theory.md (14), that multiplies the accelerations: rows first .. first +
/// count - 1, columns 0 .. n - 1.
/// @param equations must hold the design.
/// @returns its nonzeros, with rows counted from `first`.
std::vector<Eigen::Triplet<double>> acceleration_block(const CompiledSystem& system,
                                                       Equations<double>* equations,
                                                       const State<double>& state, int first,
                                                       int count);

/// Phi_q at a state, constraints x n: the rows of G below the rows of the bodies. `equations` must
/// hold the design.
SparseMatrix constraint_jacobian(const CompiledSystem& system, Equations<double>* equations,
                                 const State<double>& state);

/// Refuses a mechanism whose accelerations are not determined. Bodies may lack mass, or inertia
/// about some axes, as long as v^T M v > 0 for every velocity v that the constraints allow, Phi_q v
/// = 0; doc/theory.md (14a). The check uses the last positions of `assembly` and does nothing if
/// every body has mass and inertia.
/// @param equations must hold the design at `parameters`.
/// @throws InputError that names the link, the axis and the joint rates of a motion without
/// inertia.
void require_determined_motion(const CompiledSystem& system, const std::vector<double>& parameters,
                               const Assembly& assembly, Equations<double>* equations);

/// Refuses a motion that is given, theory (8b), of a joint whose motion the loops, the couplings
/// and the other given motions determine already, at the last positions of `assembly`.
/// @throws InputError that names the joint.
void require_free_drives(const CompiledSystem& system, const std::vector<double>& parameters,
                         const Assembly& assembly, const Equations<double>& equations);

}  // namespace codesign
