// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "equations/equations.h"

#include "codegen/number_types.h"
#include "elements/sampled_control.h"

namespace codesign {

// With double, these few values per step come from the formulas: to record them, and to make their code, would take longer than most runs.

template <class T>
void Equations<T>::linearize_rates(const State<T>& state, Linearization<T>* derivatives) {
  if (!system_.has_rates_apart()) return linearize(state, derivatives);
  T g(0.0);
  rates(state, &residual_, &g, derivatives);
}

template <class T>
T Equations<T>::terminal(const State<T>& state) {
  if constexpr (kIsReal)
    return formulas_.terminal(state);
  else
    return signals_.signal(EquationFunction::kTerminal, state);
}

template <class T>
T Equations<T>::watched(std::size_t k, const State<T>& state) {
  if constexpr (kIsReal)
    return formulas_.watched(k, state);
  else
    return signals_.signal(watched_function(k), state);
}

template <class T>
void Equations<T>::residuals(ObjectivePart part, const State<T>& state, VectorX<T>* residuals) {
  const bool terminal = part == ObjectivePart::kTerminal;
  if constexpr (kIsReal)
    formulas_.residuals(part, state, residuals);
  else
    signals_.residuals(terminal ? EquationFunction::kTerminalResiduals : EquationFunction::kIntegralResiduals, state,
                       (terminal ? system_.terminal() : system_.integral()).size(), residuals);
}

template <class T>
void Equations<T>::track_turns(State<T>* state) {
  if constexpr (kIsReal)
    formulas_.track_turns(state);
  else
    start_.track_turns(state);
}

template <class T>
T Equations<T>::sample(int controller, bool is_first, State<T>* state) {
  if constexpr (kIsReal)
    return formulas_.sample(controller, is_first, &state->s);
  else
    return start_.sample(controller, is_first, state);
}

template <class T>
void Equations<T>::begin_controllers(State<T>* state) {
  if constexpr (kIsReal) formulas_.load(*state);
  const auto sampled = [&](int controller, bool is_first) { return sample(controller, is_first, state); };
  const auto error = [&](int controller) {
    if constexpr (kIsReal)
      return formulas_.controller_error(controller);
    else
      return start_.controller_error(controller, *state);
  };
  for (std::size_t c = 0; c < system_.controllers().size(); ++c) begin_controller(system_, static_cast<int>(c), sampled, error, &state->s);
}

template <class T>
void Equations<T>::jump(const std::vector<ControlEvent>& events, State<T>* state) {
  if constexpr (kIsReal) formulas_.load(*state);
  const auto sampled = [&](int controller, bool is_first) { return sample(controller, is_first, state); };
  for (const ControlEvent& event : events) jump_controller(system_, event, sampled, &state->s);
}

#define CODESIGN_INSTANTIATE(T)                                                       \
  template void Equations<T>::linearize_rates(const State<T>&, Linearization<T>*);    \
  template T Equations<T>::terminal(const State<T>&);                                 \
  template T Equations<T>::watched(std::size_t, const State<T>&);                     \
  template void Equations<T>::residuals(ObjectivePart, const State<T>&, VectorX<T>*); \
  template void Equations<T>::track_turns(State<T>*);                                 \
  template void Equations<T>::begin_controllers(State<T>*);                           \
  template void Equations<T>::jump(const std::vector<ControlEvent>&, State<T>*);
CODESIGN_FOR_EACH_VALUE_TYPE(CODESIGN_INSTANTIATE)
#undef CODESIGN_INSTANTIATE

}  // namespace codesign
