// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "codegen/traced.h"
#include "math/arrays.h"
#include "math/scalar.h"
#include "sparse/sparsity.h"
#include "system/system.h"

namespace codesign {

/// Whether a recorded square matrix is symmetric and positive definite, judged at one generic state
/// and the system's own design.
/// @param pattern its entries; a last row, of the integrand, is left out.
bool is_mass_matrix(const System& system, const Recording& recording, const Sparsity& pattern,
                    const std::vector<Traced>& entries);

/// The pattern of the factors of a mass matrix A = L^T D L, for further solves with values that a
/// program has written: per row the entries of D L left of the diagonal, then the inverse of D's.
struct MassFactor {
  std::vector<int> starts, columns;  ///< of the entries left of the diagonal

  std::size_t size() const { return columns.size() + starts.size() - 1; }
  /// Overwrites x, N right-hand sides side by side per row, with A^-1 x. @param values size() of
  /// them.
  template <int N>
  void solve(In<double> values, Out<double> x) const;
};

struct MassSolution {
  VectorX<Traced> x;
  MassFactor factor;
  std::vector<Traced> values;  ///< of the factor
};

/// Records x with A x = b for a symmetric positive definite matrix, which needs no choice of
/// pivots, as A = L^T D L (Featherstone, Rigid Body Dynamics Algorithms, 2008, section 6.5): from
/// the last unknown to the first, so that the branches of a tree do not fill in where parents
/// precede their children. Entries above the diagonal are not read.
MassSolution record_mass_solution(const Sparsity& pattern, const std::vector<Traced>& entries,
                                  const VectorX<Traced>& b);

/// Whether a recorded residual G is affine in z and the integrand g free of it: neither G_z, g nor
/// a decision depends on z.
bool is_affine(const Recording& recording, const std::vector<Recording::Guard>& guards,
               const std::vector<Traced>& G_z, const Traced& g);

}  // namespace codesign
