// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "equations/equations.h"
#include "integration/increment.h"
#include "math/arrays.h"
#include "sensitivity/lane_directions.h"

namespace codesign {

/// Directional derivatives of the equations along (y', e_k) for N parameters at once, (18), by the
/// recorded equations. A prime denotes a directional derivative; only derivatives are returned, not
/// values. No allocation once warm.
template <int N>
class TangentEquations {
 public:
  explicit TangentEquations(const CompiledSystem& system);

  /// The equations with lanes, which hold the design with its directions.
  Equations<Lanes<N>>& equations() { return equations_; }

  /// G', one column per row of G, and g' in the last column. @param y directions of the state, in
  /// the order of IncrementLayout.
  void residual(const State<double>& state, const Directions<N>& y, Directions<N>* result);

  /// Computes the changes dG_q, dG_v and dG_z, integrand's row included, on
  /// CompiledSystem::patterns() with N numbers per entry, and dG_t.
  void linearize(const State<double>& state, const Directions<N>& y);
  const ByVariable<LineVector>& changes() const { return changes_; }
  const Directions<N>& time_changes() const { return time_changes_; }

  /// Phi' and (Phi_q v)'.
  void constraint_errors(const State<double>& state, const Directions<N>& y, Directions<N>* Phi,
                         Directions<N>* Phi_rate);

  /// The state with its directions in lanes, valid until the next call.
  const State<Lanes<N>>& lanes(const State<double>& state, const Directions<N>& y);

 private:
  void run(EquationFunction function, const State<double>& state, const Directions<N>& y,
           const Out<double> (&results)[4]);

  const Layout& layout_;
  const IncrementLayout at_;
  Equations<Lanes<N>> equations_;
  ByVariable<LineVector> changes_;
  Directions<N> time_changes_;
  State<Lanes<N>> state_;  ///< of lanes()
};

}  // namespace codesign
