// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_SENSITIVITY_TANGENT_EQUATIONS_H_
#define MECHANISM_CODESIGN_SENSITIVITY_TANGENT_EQUATIONS_H_

#include "equations/equations.h"
#include "integration/increment.h"
#include "sensitivity/lane_directions.h"

namespace codesign {

/// Directional derivatives of the equations along (y', e_k) for N parameters at once, without their values. No allocation once warm.
template <int N>
class TangentEquations {
 public:
  explicit TangentEquations(const CompiledSystem& system);

  /// The design with its directions, whole turns, and everything else that is not asked for in every step.
  Equations<Lanes<N>>& equations() { return equations_; }

  /// G' and, in the last column, g'. @param y directions of the state, as IncrementLayout lays them out.
  void residual(const State<double>& state, const Directions<N>& y, Directions<N>* result);

  /// dG_q, dG_v and dG_z with the integrand's row, on CompiledSystem::patterns(), N numbers per entry; dG_t likewise.
  void linearize(const State<double>& state, const Directions<N>& y);
  const ByVariable<LineVector>& changes() const { return changes_; }
  const Directions<N>& time_changes() const { return time_changes_; }

  /// Phi' and (Phi_q v)'.
  void constraint_errors(const State<double>& state, const Directions<N>& y, Directions<N>* Phi, Directions<N>* Phi_rate);

  /// Values and directions side by side.
  const State<Lanes<N>>& lanes(const State<double>& state, const Directions<N>& y);

 private:
  bool run_compiled(EquationFunction function, const State<double>& state, const Directions<N>& y, double* const (&results)[4]);

  const Layout& layout_;
  const AssemblyPlan& plan_;
  const IncrementLayout at_;
  Equations<Lanes<N>> equations_;
  ByVariable<LineVector> changes_;
  Directions<N> time_changes_;

  // Where there is no code.
  State<Lanes<N>> state_;
  Linearization<Lanes<N>> derivatives_;
  VectorX<Lanes<N>> residual_, errors_, rates_;
};

}  // namespace codesign

#endif  // MECHANISM_CODESIGN_SENSITIVITY_TANGENT_EQUATIONS_H_
