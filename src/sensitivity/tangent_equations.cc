// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "sensitivity/tangent_equations.h"

namespace codesign {

template <int N>
TangentEquations<N>::TangentEquations(const CompiledSystem& system)
    : layout_(system.layout()), at_(layout_), equations_(system) {
  const ByVariable<Sparsity>& patterns = system.patterns();
  changes_.position.resize(N * patterns.position.column_index.size());
  changes_.velocity.resize(N * patterns.velocity.column_index.size());
  changes_.rate.resize(N * patterns.rate.column_index.size());
  time_changes_.resize(layout_.columns() + 1);
  state_.resize(layout_);
}

template <int N>
void TangentEquations<N>::run(EquationFunction function, const State<double>& state,
                              const Directions<N>& y, const Out<double> (&results)[4]) {
  equations_.compiled().tangents(function, state.t, state.turns,
                                 {state.q, state.v, state.s, state.z},
                                 {y.part(at_.x(), at_.n), y.part(at_.v(), at_.n),
                                  y.part(at_.s(), at_.states), y.part(at_.z(), at_.z_size)},
                                 results);
}

template <int N>
const State<Lanes<N>>& TangentEquations<N>::lanes(const State<double>& state,
                                                  const Directions<N>& y) {
  load_lanes(at_, state, y, &state_);
  return state_;
}

template <int N>
void TangentEquations<N>::residual(const State<double>& state, const Directions<N>& y,
                                   Directions<N>* result) {
  const int last = layout_.columns();
  result->resize(last + 1);
  run(EquationFunction::kResidual, state, y,
      {result->part(0, last), result->part(last, 1), {}, {}});
}

template <int N>
void TangentEquations<N>::linearize(const State<double>& state, const Directions<N>& y) {
  run(EquationFunction::kLinearization, state, y,
      {changes_.position, changes_.velocity, changes_.rate, time_changes_});
}

template <int N>
void TangentEquations<N>::constraint_errors(const State<double>& state, const Directions<N>& y,
                                            Directions<N>* Phi, Directions<N>* Phi_rate) {
  Phi->resize(layout_.m);
  Phi_rate->resize(layout_.m);
  run(EquationFunction::kConstraintErrors, state, y, {*Phi, *Phi_rate, {}, {}});
}

template class TangentEquations<4>;
template class TangentEquations<8>;

}  // namespace codesign
