// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <atomic>
#include <vector>

#include "equations/equations.h"
#include "equations/iteration_matrix.h"
#include "math/arrays.h"
#include "mechanism_codesign/status.h"
#include "system/state.h"

namespace codesign {

class CompiledSystem;

/// The memory that RateSolution::extend() computes in; reused from call to call.
template <class T>
struct RateWorkspace {
  VectorX<T> G;
  Eigen::MatrixXd change;
};

/// The rates z of a state, its accelerations, multipliers and rates of extra states, that solve
/// G(q, v, s; z) = 0, (19), and what derives from the solution. Not thread-safe.
class RateSolution {
 public:
  /// @param system must outlive this.
  explicit RateSolution(const CompiledSystem& system);

  /// Solves for state->z, starting from the present state->z.
  Status solve(Equations<double>* equations, State<double>* state);
  /// Overwrites x with the solution of G_z y = x at the last solution.
  void solve_linear(Out<double> x) const;
  /// Sets state->z to the last solution with its exact first-order parts, which follow from the
  /// first-order parts of the rest of `state`. @param z that solution; it must belong to the values
  /// of `state`. @param equations must hold the design, derivatives included.
  template <class T>
  void extend(const VectorX<double>& z, Equations<T>* equations, RateWorkspace<T>* workspace,
              State<T>* state) const;
  template <class T>
  void extend(const VectorX<double>& z, Equations<T>* equations, State<T>* state) const {
    RateWorkspace<T> workspace;
    extend(z, equations, &workspace, state);
  }
  /// The time derivative of z at the last solution, where q, v and s change as `rates` says [per
  /// s]; written to rates->z. @param at that solution.
  void differentiate(const State<double>& at, Equations<double>* equations, State<double>* rates);

  /// IterationMatrix::reset_pivots(): the next solution chooses pivots, or begins with the kept
  /// ones.
  void reset_pivots() { matrix_.reset_pivots(); }
  /// SparseLu::keep_pivots() after a solution, whose pivots later solutions begin with.
  void keep_pivots() { matrix_.keep_pivots(); }
  /// With the kept pivots.
  const IterationMatrix& matrix() const { return matrix_; }
  /// As Assembly::obey().
  void obey(const std::atomic<bool>* cancel) { cancel_ = cancel; }

 private:
  const CompiledSystem& system_;
  Linearization<double> derivatives_;
  /// Factored at the last solution, unless that has mass factors.
  IterationMatrix matrix_;
  /// The factors of that solution if an expression gave it, and their values.
  const MassFactor* factor_ = nullptr;
  std::vector<double> factor_values_;
  VectorX<double> residual_;
  const std::atomic<bool>* cancel_ = nullptr;
};

}  // namespace codesign
