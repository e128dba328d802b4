// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <vector>

#include "math/arrays.h"
#include "sparse/sparse_lu.h"
#include "sparse/sparsity.h"
#include "system/state.h"

namespace codesign {

class CompiledSystem;
class LazyStraightLine;

/// The square matrix of every implicit solve for z = (a, lambda, sigma), with its LU factorization:
/// G_z, plus c_v G_v + c_q G_q in the columns of a, plus c_s G_s in the columns of sigma; theory
/// (16). The row of the integrand is left out. The pattern is fixed.
///
/// c_v = c_q = c_s = 0 gives G_z, for accelerations and multipliers; c_v = c_s = h gamma, c_q = (h
/// gamma)^2 the matrix of a Rosenbrock stage; c_v = c_s = 1/c_j, c_q = 1/c_j^2 the matrix of IDAS,
/// theory (26).
class IterationMatrix {
 public:
  /// @param machine_code whether compiled code forms the sums, where it is available; else loops
  /// do.
  explicit IterationMatrix(const CompiledSystem& system, bool machine_code = true);
  ~IterationMatrix();
  IterationMatrix(IterationMatrix&&) noexcept;
  IterationMatrix& operator=(IterationMatrix&&) noexcept;

  /// Forms the matrix and factors it. @param derivatives on CompiledSystem::patterns(). Returns
  /// false if the matrix is singular.
  bool factor(const Linearization<double>& derivatives, double c_v, double c_q, double c_s);
  /// SparseLu::reset_pivots().
  void reset_pivots() { lu_.reset_pivots(); }
  /// SparseLu::keep_pivots().
  void keep_pivots() { lu_.keep_pivots(); }
  /// SparseLu::keep_pivots_of(). @param other of the same system.
  void keep_pivots_of(const IterationMatrix& other) { lu_.keep_pivots_of(other.lu_); }
  /// The factorization of the last factor().
  const SparseLu& lu() const { return lu_; }

  /// The pattern in compressed-column form, as SparseLu takes it, and the nonzero (slot) that each
  /// entry of G_q, G_s, G_v and G_z adds to.
  struct Pattern {
    /// An entry of one of the three matrices of a Linearization and the nonzero of this matrix that
    /// it adds to.
    struct Source {
      int entry, slot;
    };
    std::vector<int> column_start, row_index;
    std::vector<Source> q, s, v, z;

    explicit Pattern(const CompiledSystem& system);
  };

 private:
  /// Forms values_ by loops.
  void add_up(const Linearization<double>& derivatives, double c_v, double c_q, double c_s);

  Pattern pattern_;
  std::vector<double> values_;
  std::unique_ptr<LazyStraightLine> code_;  ///< forms values_, if available
  SparseLu lu_;
};

/// The derivative of (G, g), theory (14), along a direction of the state: G_q q + G_s s + G_v v +
/// G_z z; the last entry is the derivative of g. The time of `direction` is ignored.
/// @param result resized to Layout::columns() + 1 and overwritten.
void directional_derivative(const CompiledSystem& system, const Linearization<double>& derivatives,
                            const State<double>& direction, VectorX<double>* result);

/// result -= factor * G_q q. @param q n entries. @param result Layout::columns() entries; g has
/// none.
void subtract_position_product(const CompiledSystem& system,
                               const Linearization<double>& derivatives, In<double> q,
                               double factor, Out<double> result);

}  // namespace codesign
