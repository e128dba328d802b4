// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "equations/equations.h"

#include "codegen/number_types.h"
#include "elements/sampled_control.h"
#include "equations/compiled_system.h"
#include "equations/formulas.h"
#include "math/arrays.h"

namespace codesign {

template <class T>
Equations<T>::Equations(const CompiledSystem& system)
    : system_(system),
      compiled_(system),
      signals_(system, EquationPart::kSignals),
      start_(system, EquationPart::kStart) {
  if constexpr (kIsReal) formulas_ = std::make_unique<Formulas<T>>(system);
}

template <class T>
Equations<T>::Equations(Equations&&) noexcept = default;
template <class T>
Equations<T>::~Equations() = default;

template <class T>
void Equations<T>::set_design(const std::vector<T>& parameters) {
  for (CompiledEquations<T>* part : {&compiled_, &signals_, &start_}) part->set_design(parameters);
  if constexpr (kIsReal) formulas_->set_design(parameters);
}

template <>
const Constants<double>& Equations<double>::constants() const {
  return formulas_->view().design.constants;
}

template <>
const PairRows<double>& Equations<double>::rows(int pair) const {
  return formulas_->view().design.rows[to_index(pair)];
}

// With double, these few values per step come from the formulas: to record them, and to make their
// code, would take longer than most runs.

template <class T>
void Equations<T>::linearize_rates(const State<T>& state, Linearization<T>* derivatives) {
  if (!system_.has_rates_apart()) return linearize(state, derivatives);
  T g(0.0);
  rates(state, &residual_, &g, derivatives);
}

template <class T>
T Equations<T>::terminal(const State<T>& state) {
  if constexpr (kIsReal)
    return formulas_->terminal(state);
  else
    return signals_.signal(EquationFunction::kTerminal, state);
}

template <class T>
T Equations<T>::watched(std::size_t k, const State<T>& state) {
  if constexpr (kIsReal)
    return formulas_->watched(k, state);
  else
    return signals_.signal(watched_function(k), state);
}

template <class T>
void Equations<T>::residuals(ObjectivePart part, const State<T>& state, VectorX<T>* residuals) {
  const bool terminal = part == ObjectivePart::kTerminal;
  if constexpr (kIsReal)
    formulas_->residuals(part, state, residuals);
  else
    signals_.residuals(
        terminal ? EquationFunction::kTerminalResiduals : EquationFunction::kIntegralResiduals,
        state, (terminal ? system_.terminal() : system_.integral()).size(), residuals);
}

template <class T>
void Equations<T>::track_turns(State<T>* state) {
  // The coordinates of the forest's pairs count whole turns themselves.
  if (system_.layout().has_cuts()) compiled_.track_turns(state);
}

template <class T>
void Equations<T>::stuck_slips(const State<T>& state, VectorX<T>* accelerations,
                               VectorX<T>* limits) {
  if constexpr (kIsReal) {
    formulas_->load(state);
    formulas_->stuck_slips(accelerations, limits);
  } else {
    start_.stuck_slips(state, accelerations, limits);
  }
}

template <class T>
void Equations<T>::begin_states(State<T>* state) {
  if (system_.begins_bristles()) begin_bristles(state);
  if (system_.begins_controllers()) begin_controllers(state);
}

template <class T>
void Equations<T>::begin_bristles(State<T>* state) {
  if constexpr (kIsReal) {
    formulas_->load(*state);
    formulas_->begin_bristles(&state->s);
  } else {
    start_.begin_bristles(state);
  }
}

template <class T>
T Equations<T>::sample(int controller, bool is_first, State<T>* state) {
  if constexpr (kIsReal)
    return formulas_->sample(controller, is_first, &state->s);
  else
    return start_.sample(controller, is_first, state);
}

template <class T>
void Equations<T>::begin_controllers(State<T>* state) {
  if constexpr (kIsReal) formulas_->load(*state);
  const auto sampled = [&](int controller, bool is_first) {
    return sample(controller, is_first, state);
  };
  for (std::size_t c = 0; c < system_.controllers().size(); ++c)
    begin_controller(system_, static_cast<int>(c), sampled, &state->s);
}

template <class T>
void Equations<T>::jump(const std::vector<ControlEvent>& events, State<T>* state) {
  if constexpr (kIsReal) formulas_->load(*state);
  const auto sampled = [&](int controller, bool is_first) {
    return sample(controller, is_first, state);
  };
  for (const ControlEvent& event : events) jump_controller(system_, event, sampled, &state->s);
}

#define CODESIGN_INSTANTIATE(T) template class Equations<T>;
CODESIGN_FOR_EACH_VALUE_TYPE(CODESIGN_INSTANTIATE)
#undef CODESIGN_INSTANTIATE

}  // namespace codesign
