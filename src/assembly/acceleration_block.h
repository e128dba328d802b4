// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/SparseCore>
#include <vector>

#include "equations/equations.h"
#include "sparse/least_squares.h"

namespace codesign {

/// The part of G_z, doc/theory.md (14), that multiplies the accelerations: rows first .. first + count - 1, columns 0 .. n - 1.
/// @param equations must hold the design.
/// @returns its nonzeros, with rows counted from `first`.
std::vector<Eigen::Triplet<double>> acceleration_block(const CompiledSystem& system, Equations<double>* equations,
                                                       const State<double>& state, int first, int count);

/// Phi_q at a state, constraints x n: the rows of G below the rows of the bodies. `equations` must hold the design.
SparseMatrix constraint_jacobian(const CompiledSystem& system, Equations<double>* equations, const State<double>& state);

}  // namespace codesign
