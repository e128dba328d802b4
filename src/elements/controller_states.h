// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_ELEMENTS_CONTROLLER_STATES_H_
#define MECHANISM_CODESIGN_ELEMENTS_CONTROLLER_STATES_H_

#include "elements/controllers.h"

namespace codesign {

// The rows sigma - s' of the states of controllers, theory (50)-(53). The states of a sampled controller change only at its samples, so
// that its rows are sigma = 0.

/// s' of the integral of a controller. Appends its gradient.
template <class T>
T integral_rate(const StateView<T>& view, int controller, OptionalGradient<T> gradient) {
  const ControlRealization& realization = realization_of(view, controller);
  if (realization.is_sampled()) return T(0.0);
  const auto before = mark(gradient);
  const T error = controller_error(view, controller, gradient);
  if (!realization.antiwindup) return error;
  const ControllerConstants<T>& k = view.design.controllers[static_cast<std::size_t>(controller)];
  const int s = view.system.controllers()[static_cast<std::size_t>(controller)].state;
  const IntegralRate<T> rate = clamped_integral_rate(error, view.state->s[s], k.pid.i, k.i_clamp);
  if (gradient) {
    gradient->scale_from(before, rate.by_error);
    gradient->position.push_back({view.layout.position_column(s), rate.by_integral});
  }
  return rate.value;
}

/// f' = (u - f) / tau of the effort after the drive's lag, (53). Appends its gradient.
template <class T>
T lag_rate(const StateView<T>& view, int controller, OptionalGradient<T> gradient) {
  const int f = view.system.controllers()[static_cast<std::size_t>(controller)].states.lag;
  const T per_tau = T(1.0) / view.design.controllers[static_cast<std::size_t>(controller)].time_constant;
  const auto before = mark(gradient);
  const T output = controller_output(view, controller, gradient);
  if (gradient) {
    gradient->scale_from(before, per_tau);
    gradient->position.push_back({view.layout.position_column(f), T(-per_tau)});
  }
  return per_tau * (output - view.state->s[f]);
}

/// Calls visit(state, rate) for each state of a controller: its index, and a function (gradient) -> s' that appends the gradient.
template <class T, class Visit>
void visit_controller_states(const StateView<T>& view, int controller, const Visit& visit) {
  const Controller& resolved = view.system.controllers()[static_cast<std::size_t>(controller)];
  const ControlRealization& realization = realization_of(view, controller);
  const auto constant = [](OptionalGradient<T>) { return T(0.0); };
  if (resolved.state >= 0) visit(resolved.state, [&](OptionalGradient<T> gradient) { return integral_rate(view, controller, gradient); });
  const ControllerStates& states = resolved.states;
  if (states.filter >= 0 && !realization.is_sampled())
    visit(states.filter, [&](OptionalGradient<T> gradient) { return filtered_error_rate(view, controller, gradient); });
  else if (states.filter >= 0)
    visit(states.filter, constant);
  if (states.last >= 0) visit(states.last, constant);
  if (states.held >= 0) visit(states.held, constant);
  for (int k = 0; k < realization.queued(); ++k) visit(states.queue + k, constant);
  if (states.lag >= 0) visit(states.lag, [&](OptionalGradient<T> gradient) { return lag_rate(view, controller, gradient); });
}

/// Sets the rows of a controller's states to sigma - s'; nothing for controllers without a state.
template <class T>
void controller_residual(const StateView<T>& view, std::size_t c, VectorX<T>* G) {
  visit_controller_states(view, static_cast<int>(c), [&](int state, const auto& rate) {
    const int row = view.layout.state_column(state);
    (*G)[row] = view.state->z[row] - rate(nullptr);
  });
}

}  // namespace codesign

#endif  // MECHANISM_CODESIGN_ELEMENTS_CONTROLLER_STATES_H_
