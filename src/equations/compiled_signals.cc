// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
// What CompiledEquations evaluates beside the motion: signals, residuals of the objective, starts,
// controllers, modes, errors of constraints and energies.
#include <complex>
#include <utility>

#include "codegen/number_types.h"
#include "equations/compiled_equations.h"
#include "equations/variant_inputs.h"
#include "math/arrays.h"

namespace codesign {

template <class T>
const std::vector<bool>& CompiledEquations<T>::mode_of(const State<T>& state) {
  const bool held = std::exchange(held_, false);
  T g(0.0);
  residual(state, &residual_, &g);
  held_ = held;
  return variants_[current_].code().mode();
}

template <class T>
void CompiledEquations<T>::switches(const State<T>& state, VectorX<T>* differences,
                                    VectorX<T>* right) {
  for (VectorX<T>* results : {differences, right}) results->resize(to_signed(mode_.size()));
  run(EquationFunction::kSwitches, state, {*differences, *right, {}, {}});
}

template <class T>
const SwitchOrigin* CompiledEquations<T>::switch_origin(const std::vector<bool>& mode,
                                                        std::size_t k) const {
  for (const VariantInputs<T>& variant : variants_) {
    const EquationVariant& code = variant.code();
    if (code.mode() == mode && k < mode.size()) return &code.switch_origins()[k];
  }
  return nullptr;
}

template <class T>
void CompiledEquations<T>::constraint_errors(const State<T>& state, VectorX<T>* Phi,
                                             VectorX<T>* Phi_rate) {
  Phi->resize(system_.layout().m);
  Phi_rate->resize(system_.layout().m);
  run(EquationFunction::kConstraintErrors, state.t, state.turns, {state.q, state.v, {}, {}},
      {*Phi, *Phi_rate, {}, {}});
}

template <class T>
void CompiledEquations<T>::energies(const State<T>& state, VectorX<T>* sums, VectorX<T>* bodies) {
  run(EquationFunction::kEnergies, state, {*sums, *bodies, {}, {}});
}

template <class T>
T CompiledEquations<T>::signal(EquationFunction function, const State<T>& state) {
  T value(0.0);
  run(function, state, {{&value, 1}, {}, {}, {}});
  return value;
}

template <class T>
void CompiledEquations<T>::residuals(EquationFunction function, const State<T>& state,
                                     std::size_t size, VectorX<T>* residuals) {
  residuals->resize(to_signed(size));
  run(function, state, {*residuals, {}, {}, {}});
}

template <class T>
void CompiledEquations<T>::place(const VectorX<T>& theta, const VectorX<T>& theta_rate,
                                 State<T>* state) {
  run(EquationFunction::kPlacement, 0.0, state->turns, {theta, theta_rate, {}, {}},
      {state->q, state->v, {}, {}});
}

template <class T>
void CompiledEquations<T>::track_turns(State<T>* state) {
  // The program sets those of cut pairs.
  entries_.assign(state->turns.begin(), state->turns.begin() + system_.layout().drop_slot);
  run(EquationFunction::kTurns, *state, {entries_, {}, {}, {}});
  for (std::size_t k = 0; k < entries_.size(); ++k) state->turns[k] = value_of(entries_[k]);
}

template <class T>
void CompiledEquations<T>::stuck_slips(const State<T>& state, VectorX<T>* accelerations,
                                       VectorX<T>* limits) {
  run(EquationFunction::kStuckSlips, state, {*accelerations, *limits, {}, {}});
}

template <class T>
void CompiledEquations<T>::begin_bristles(State<T>* state) {
  s_.resize(state->s.size());
  run(EquationFunction::kBristles, *state, {s_, {}, {}, {}});
  state->s = s_;
}

template <class T>
T CompiledEquations<T>::sample(int controller, bool is_first, State<T>* state) {
  T output(0.0);
  s_.resize(state->s.size());
  run(controller_function(
          controller, is_first ? ControllerFunction::kFirstSample : ControllerFunction::kSample),
      *state, {{&output, 1}, s_, {}, {}});
  state->s = s_;
  return output;
}

template <class T>
T CompiledEquations<T>::signal(EquationFunction function, const State<T>& state,
                               SparseGradient<T>* gradient) {
  const Layout& layout = system_.layout();
  const int velocity = layout.positions(), rate = velocity + layout.n,
            time = rate + layout.columns();
  entries_.resize(to_index(time) + 1);
  T value(0.0);
  run(with_gradient(function), state, {{&value, 1}, entries_, {}, {}});
  gradient->clear();
  const std::vector<int>& columns =
      variants_[current_].code().gradient_columns(with_gradient(function));
  for (std::size_t k = 0; k < columns.size(); ++k) {
    const int c = columns[k];
    if (c < velocity)
      gradient->position.push_back({c, entries_[k]});
    else if (c < rate)
      gradient->velocity.push_back({c - velocity, entries_[k]});
    else if (c < time)
      gradient->rate.push_back({c - rate, entries_[k]});
    else
      gradient->time = entries_[k];
  }
  return value;
}

#define CODESIGN_INSTANTIATE(T)                                                                   \
  template const std::vector<bool>& CompiledEquations<T>::mode_of(const State<T>&);               \
  template void CompiledEquations<T>::switches(const State<T>&, VectorX<T>*, VectorX<T>*);        \
  template const SwitchOrigin* CompiledEquations<T>::switch_origin(const std::vector<bool>&,      \
                                                                   std::size_t) const;            \
  template void CompiledEquations<T>::constraint_errors(const State<T>&, VectorX<T>*,             \
                                                        VectorX<T>*);                             \
  template void CompiledEquations<T>::energies(const State<T>&, VectorX<T>*, VectorX<T>*);        \
  template T CompiledEquations<T>::signal(EquationFunction, const State<T>&);                     \
  template T CompiledEquations<T>::signal(EquationFunction, const State<T>&, SparseGradient<T>*); \
  template void CompiledEquations<T>::residuals(EquationFunction, const State<T>&, std::size_t,   \
                                                VectorX<T>*);                                     \
  template void CompiledEquations<T>::place(const VectorX<T>&, const VectorX<T>&, State<T>*);     \
  template void CompiledEquations<T>::track_turns(State<T>*);                                     \
  template void CompiledEquations<T>::stuck_slips(const State<T>&, VectorX<T>*, VectorX<T>*);     \
  template void CompiledEquations<T>::begin_bristles(State<T>*);                                  \
  template T CompiledEquations<T>::sample(int, bool, State<T>*);
CODESIGN_FOR_EACH_VALUE_TYPE(CODESIGN_INSTANTIATE)
#undef CODESIGN_INSTANTIATE

}  // namespace codesign
