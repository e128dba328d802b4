// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "elements/controllers.h"
#include "elements/joint_load.h"
#include "math/arrays.h"

namespace codesign {

// The rate of the effort of a joint, theory (54).

/// -x' or -x'', the k-th derivative of minus the input of a PID, k = 1 or 2; behind filters x'
/// alone.
template <class T>
T input_derivative(const StateView<T>& view, int controller, int k) {
  const Controller& of = view.controller(controller);
  const T raw = signal_value(view, of.output_rate[to_index(k - 1)]);
  return of.states.inputs.front().empty()
             ? T(-raw)
             : T(-filtered_rate(view, controller, 0, signal_value(view, of.input), raw));
}

/// r' - x' or r'' - x'', the k-th derivative of the error of a PID.
template <class T>
T error_derivative(const StateView<T>& view, int controller, int k) {
  const ReferenceMotion<T> setpoint =
      view.controller_numbers(controller).setpoint.at(view.state->t);
  return (k == 1 ? setpoint.rate : setpoint.acceleration) + input_derivative(view, controller, k);
}

/// The rate of the integral term of a PID.
template <class T>
T integral_term_rate(const StateView<T>& view, int controller) {
  const ControllerConstants<T>& k = view.controller_numbers(controller);
  const ControlRealization& realization = realization_of(view, controller);
  const int s = view.controller(controller).state;
  if (s < 0) return T(0.0);
  const T rate = k.pid.i * integral_rate(view, controller);
  if (!realization.i_clamp || realization.antiwindup == AntiWindup::kClamping) return rate;
  return saturate(T(k.pid.i * view.state->s[s]), k.i_clamp).slope * rate;
}

/// k_d times the rate of what the derivative acts on, or of its filtered value.
template <class T>
T derivative_term_rate(const StateView<T>& view, int controller) {
  const ControllerConstants<T>& k = view.controller_numbers(controller);
  if (view.system.study().controllers[to_index(controller)].d.is_zero()) return T(0.0);
  const auto derivative = [&](int order) {
    return realization_of(view, controller).rates_input ? input_derivative(view, controller, order)
                                                        : error_derivative(view, controller, order);
  };
  if (view.controller(controller).states.filter < 0) return k.pid.d * derivative(2);
  return k.pid.d / k.derivative_filter * (derivative(1) - filtered_error_rate(view, controller));
}

/// The rate of the output by the law of a continuous controller; Controller::has_output_rate must
/// be true.
template <class T>
T law_rate(const StateView<T>& view, int controller) {
  const ControllerConstants<T>& k = view.controller_numbers(controller);
  if (view.controller(controller).kind->is_pid)
    return k.pid.p * error_derivative(view, controller, 1) + integral_term_rate(view, controller) +
           derivative_term_rate(view, controller);
  T sum = k.feedforward.at(view.state->t).rate;
  for (std::size_t term = 0; term < k.gains.size(); ++term)
    sum += k.gains[term] *
           (k.references[term].at(view.state->t).rate -
            filtered_rate(view, controller, term,
                          signal_value(view, view.controller(controller).feedback[term]),
                          signal_value(view, view.controller(controller).output_rate[term])));
  return sum;
}

/// The rate of drive_effort().
template <class T>
T drive_effort_rate(const StateView<T>& view, int controller) {
  if (view.controller(controller).states.lag >= 0) return lag_rate(view, controller);
  const T rate = law_rate(view, controller);
  if (!realization_of(view, controller).output_limit) return rate;
  return limited_output(view, controller).slope * rate;
}

/// The rate of winding_effort(), n K i'.
template <class T>
T winding_effort_rate(const StateView<T>& view, const Winding& winding) {
  const T nK = effort_per_current(view, winding);
  if (winding.state >= 0) return nK * winding_current_rate(view, winding);
  const WindingConstants<T>& c = winding_numbers(view, winding);
  T rate(0.0);
  for (int controller : winding.controllers) rate += drive_effort_rate(view, controller);
  const T acceleration =
      view.dynamics(winding.pair, winding.element).gear_ratio *
      view.coordinate(winding.pair, winding.element, CoordinateDetail::kAcceleration).acceleration;
  return nK * c.steady_current(T(winding_voltage(view, winding).slope * rate), acceleration);
}

/// The rate of controller_effort().
template <class T>
T controller_effort_rate(const StateView<T>& view, const JointLoad& load) {
  T rate(0.0), demand(0.0);
  const auto* effort = load.find<ControllerEffort>();
  if (!effort) return rate;
  for (int controller : effort->controllers) rate += drive_effort_rate(view, controller);
  if (!effort->saturated) return rate;
  for (int controller : effort->controllers) demand += drive_effort(view, controller);
  const T& limit = view.dynamics(load.pair, load.element).effort;
  return saturate(demand, limit).slope * rate;
}

/// The rate of applied_effort() [N m/s or N/s].
template <class T>
T applied_effort_rate(const StateView<T>& view, const JointLoad& load) {
  const T rate = controller_effort_rate(view, load);
  const auto* torque = load.find<WindingTorque>();
  if (!torque) return rate;
  return rate + winding_effort_rate(view, view.system.windings()[to_index(torque->winding)]);
}

}  // namespace codesign
