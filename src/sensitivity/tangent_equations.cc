// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "sensitivity/tangent_equations.h"

#include "sensitivity/lane_state.h"

namespace codesign {
namespace {

template <int N>
void take_directions(const VectorX<Lanes<N>>& from, Directions<N>* to) {
  for (int k = 0; k < from.size(); ++k) to->vector(k) = from[k].v;
}

template <int N>
void take_directions(const std::vector<Lanes<N>>& from, LineVector* to) {
  for (std::size_t k = 0; k < from.size(); ++k) *reinterpret_cast<typename Lanes<N>::Vector*>(to->data() + N * k) = from[k].v;
}

}  // namespace

template <int N>
TangentEquations<N>::TangentEquations(const CompiledSystem& system)
    : layout_(system.layout()), plan_(system.plan()), at_(layout_), equations_(system) {
  const ByVariable<Sparsity>& patterns = system.patterns();
  changes_.position.resize(N * patterns.position.column_index.size());
  changes_.velocity.resize(N * patterns.velocity.column_index.size());
  changes_.rate.resize(N * patterns.rate.column_index.size());
  time_changes_.resize(layout_.columns() + 1);
  state_.resize(layout_);
  derivatives_.resize(patterns);
}

template <int N>
bool TangentEquations<N>::run_compiled(EquationFunction function, const State<double>& state, const Directions<N>& y,
                                       const Out<double> (&results)[4]) {
  return equations_.compiled().tangents(
      function, state.t, state.turns, {state.q, state.v, state.s, state.z},
      {y.part(at_.x(), at_.n), y.part(at_.v(), at_.n), y.part(at_.s(), at_.states), y.part(at_.z(), at_.z_size)}, results);
}

template <int N>
const State<Lanes<N>>& TangentEquations<N>::lanes(const State<double>& state, const Directions<N>& y) {
  load_lanes(at_, state, y, &state_);
  return state_;
}

template <int N>
void TangentEquations<N>::residual(const State<double>& state, const Directions<N>& y, Directions<N>* result) {
  const int last = layout_.columns();
  result->resize(last + 1);
  if (run_compiled(EquationFunction::kResidual, state, y, {result->part(0, last), result->part(last, 1), {}, {}})) return;
  Lanes<N> g;
  equations_.formulas().residual(lanes(state, y), &residual_, &g);
  take_directions<N>(residual_, result);
  result->vector(last) = g.v;
}

template <int N>
void TangentEquations<N>::linearize(const State<double>& state, const Directions<N>& y) {
  if (run_compiled(EquationFunction::kLinearization, state, y, {changes_.position, changes_.velocity, changes_.rate, time_changes_}))
    return;
  equations_.formulas().linearize(lanes(state, y), plan_, &derivatives_);
  take_directions<N>(derivatives_.position, &changes_.position);
  take_directions<N>(derivatives_.velocity, &changes_.velocity);
  take_directions<N>(derivatives_.rate, &changes_.rate);
  take_directions<N>(derivatives_.time, &time_changes_);
}

template <int N>
void TangentEquations<N>::constraint_errors(const State<double>& state, const Directions<N>& y, Directions<N>* Phi,
                                            Directions<N>* Phi_rate) {
  Phi->resize(layout_.m);
  Phi_rate->resize(layout_.m);
  if (run_compiled(EquationFunction::kConstraintErrors, state, y, {*Phi, *Phi_rate, {}, {}})) return;
  const State<Lanes<N>>& both = lanes(state, y);
  equations_.formulas().constraint_errors(both, &errors_, &rates_);
  take_directions<N>(errors_, Phi);
  take_directions<N>(rates_, Phi_rate);
}

template class TangentEquations<4>;
template class TangentEquations<8>;

}  // namespace codesign
