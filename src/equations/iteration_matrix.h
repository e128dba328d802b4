// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_EQUATIONS_ITERATION_MATRIX_H_
#define MECHANISM_CODESIGN_EQUATIONS_ITERATION_MATRIX_H_

#include <memory>
#include <vector>

#include "equations/compiled_system.h"
#include "sparse/sparse_lu.h"
#include "sparse/sparsity.h"

namespace codesign {

class LazyStraightLine;

/// The matrix G_z + c_v G_v + c_q G_q (G_sigma + c_s G_s for extra states) that every implicit solve needs, on one fixed pattern.
///
/// With c = 0 it gives accelerations and multipliers; with c_v = c_s = h gamma, c_q = (h gamma)^2 it is a Rosenbrock stage's; theory (16).
class IterationMatrix {
 public:
  /// @param machine_code whether to compile the sums where that is possible; loops form them otherwise.
  explicit IterationMatrix(const CompiledSystem& system, bool machine_code = true);
  ~IterationMatrix();
  IterationMatrix(IterationMatrix&&) noexcept;
  IterationMatrix& operator=(IterationMatrix&&) noexcept;

  /// Forms and factors it. False if singular.
  bool factor(const Linearization<double>& derivatives, double c_v, double c_q, double c_s);
  const SparseLu& lu() const { return lu_; }

  /// The pattern by columns, as SparseLu takes it, and where the entries of the three matrices go.
  struct Pattern {
    /// An entry of one of the matrices (of the integrand's row there are none) and its slot.
    struct Source {
      int entry, slot;
    };
    std::vector<int> column_start, row_index;
    std::vector<Source> q, s, v, z;

    explicit Pattern(const CompiledSystem& system);
  };

 private:
  void add_up(const Linearization<double>& derivatives, double c_v, double c_q, double c_s);

  Pattern pattern_;
  std::vector<double> values_;
  std::unique_ptr<LazyStraightLine> code_;  ///< that forms it
  SparseLu lu_;
};

}  // namespace codesign

#endif  // MECHANISM_CODESIGN_EQUATIONS_ITERATION_MATRIX_H_
