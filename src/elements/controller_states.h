// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "elements/controllers.h"

namespace codesign {

// The rows sigma - s' of the states of controllers, theory (50)-(53). The states of a sampled controller change only at its samples, so
// that its rows are sigma = 0.

/// s' of the integral of a controller.
template <class T>
T integral_rate(const StateView<T>& view, int controller) {
  const ControlRealization& realization = realization_of(view, controller);
  if (realization.is_sampled()) return T(0.0);
  const T error = controller_error(view, controller);
  if (!realization.antiwindup) return error;
  const ControllerConstants<T>& k = view.controller_numbers(controller);
  const int s = view.controller(controller).state;
  return clamped_integral_rate(error, view.state->s[s], k.pid.i, k.i_clamp);
}

/// f' = (u - f) / tau of the effort after the drive's lag, (53).
template <class T>
T lag_rate(const StateView<T>& view, int controller) {
  const int f = view.controller(controller).states.lag;
  const T per_tau = T(1.0) / view.controller_numbers(controller).time_constant;
  return per_tau * (controller_output(view, controller) - view.state->s[f]);
}

/// Sets the rows of a controller's states to sigma - s'; nothing for controllers without a state.
template <class T>
void controller_residual(const StateView<T>& view, std::size_t c, VectorX<T>* G) {
  const int controller = static_cast<int>(c);
  const Controller& resolved = view.system.controllers()[c];
  const ControlRealization& realization = realization_of(view, controller);
  const ControllerStates& states = resolved.states;
  const auto set = [&](int state, const T& rate) {
    const int row = view.layout.state_column(state);
    (*G)[row] = view.state->z[row] - rate;
  };
  if (resolved.state >= 0) set(resolved.state, integral_rate(view, controller));
  if (states.filter >= 0) set(states.filter, realization.is_sampled() ? T(0.0) : filtered_error_rate(view, controller));
  if (states.last >= 0) set(states.last, T(0.0));
  if (states.held >= 0) set(states.held, T(0.0));
  for (int k = 0; k < realization.queued(); ++k) set(states.queue + k, T(0.0));
  if (states.lag >= 0) set(states.lag, lag_rate(view, controller));
}

}  // namespace codesign
