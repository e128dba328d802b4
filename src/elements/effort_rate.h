// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_ELEMENTS_EFFORT_RATE_H_
#define MECHANISM_CODESIGN_ELEMENTS_EFFORT_RATE_H_

#include "elements/controller_states.h"
#include "elements/joint_load.h"

namespace codesign {

// The rate of the effort of a joint, theory (54). Functions append their gradient.

/// The rate of saturate(u, u_max) for a u that changes at a given rate. @param demand, rate functions (gradient) -> u, u'.
template <class T, class Demand, class Rate>
T saturated_rate(const T& u_max, const Demand& demand, const Rate& rate, OptionalGradient<T> gradient) {
  const auto before = mark(gradient);
  const T u_rate = rate(gradient), u = demand(OptionalGradient<T>(nullptr));
  const T slope = saturate(u, u_max).slope;
  if (gradient) {
    gradient->scale_from(before, slope);
    const auto between = mark(gradient);
    demand(gradient);
    gradient->scale_from(between, T(saturation_curvature(u, u_max) * u_rate));
  }
  return slope * u_rate;
}

/// r' - x' or r'' - x'', the k-th derivative of the error of a PID, k = 1 or 2.
template <class T>
T error_derivative(const StateView<T>& view, int controller, int k, OptionalGradient<T> gradient) {
  const auto c = static_cast<std::size_t>(controller);
  const ReferenceMotion<T> setpoint = view.design.controllers[c].setpoint.at(view.state->t);
  if (gradient) gradient->time += k == 1 ? setpoint.acceleration : setpoint.jerk;
  const Signal& signal = view.system.controllers()[c].output_rate[static_cast<std::size_t>(k - 1)];
  return (k == 1 ? setpoint.rate : setpoint.acceleration) + signal_value(view, signal, T(-1.0), gradient);
}

/// The rate of the integral term of a PID.
template <class T>
T integral_term_rate(const StateView<T>& view, int controller, OptionalGradient<T> gradient) {
  const auto c = static_cast<std::size_t>(controller);
  const ControllerConstants<T>& k = view.design.controllers[c];
  const ControlRealization& realization = realization_of(view, controller);
  const int s = view.system.controllers()[c].state;
  if (s < 0) return T(0.0);
  const auto rate = [&](OptionalGradient<T> to) {
    const auto before = mark(to);
    const T value = integral_rate(view, controller, to);
    if (to) to->scale_from(before, k.pid.i);
    return k.pid.i * value;
  };
  if (!realization.i_clamp || realization.antiwindup) return rate(gradient);
  const auto term = [&](OptionalGradient<T> to) {
    if (to) to->position.push_back({view.layout.position_column(s), k.pid.i});
    return k.pid.i * view.state->s[s];
  };
  return saturated_rate(k.i_clamp, term, rate, gradient);
}

/// k_d times the rate of e', or of the filtered e'.
template <class T>
T derivative_term_rate(const StateView<T>& view, int controller, OptionalGradient<T> gradient) {
  const auto c = static_cast<std::size_t>(controller);
  const ControllerConstants<T>& k = view.design.controllers[c];
  if (view.system.study().controllers[c].d.is_zero()) return T(0.0);
  const bool filtered = view.system.controllers()[c].states.filter >= 0;
  const T factor = filtered ? T(k.pid.d / k.derivative_filter) : k.pid.d;
  const auto before = mark(gradient);
  T value = error_derivative(view, controller, filtered ? 1 : 2, gradient);
  if (filtered) {
    const auto between = mark(gradient);
    value -= filtered_error_rate(view, controller, gradient);
    if (gradient) gradient->scale_from(between, T(-1.0));
  }
  if (gradient) gradient->scale_from(before, factor);
  return factor * value;
}

/// The rate of the output by the law of a continuous controller; Controller::has_output_rate must be true.
template <class T>
T law_rate(const StateView<T>& view, int controller, OptionalGradient<T> gradient) {
  const auto c = static_cast<std::size_t>(controller);
  const ControllerConstants<T>& k = view.design.controllers[c];
  if (view.system.controllers()[c].kind == ControllerKind::kPid) {
    const auto before = mark(gradient);
    T sum = k.pid.p * error_derivative(view, controller, 1, gradient);
    if (gradient) gradient->scale_from(before, k.pid.p);
    sum += integral_term_rate(view, controller, gradient);
    return sum + derivative_term_rate(view, controller, gradient);
  }
  const ReferenceMotion<T> feedforward = k.feedforward.at(view.state->t);
  T sum = feedforward.rate;
  if (gradient) gradient->time += feedforward.acceleration;
  for (std::size_t term = 0; term < k.gains.size(); ++term) {
    const ReferenceMotion<T> reference = k.references[term].at(view.state->t);
    sum += k.gains[term] * reference.rate + signal_value(view, view.system.controllers()[c].output_rate[term], T(-k.gains[term]), gradient);
    if (gradient) gradient->time += k.gains[term] * reference.acceleration;
  }
  return sum;
}

/// The rate of drive_effort().
template <class T>
T drive_effort_rate(const StateView<T>& view, int controller, OptionalGradient<T> gradient) {
  const auto c = static_cast<std::size_t>(controller);
  if (view.system.controllers()[c].states.lag >= 0) return lag_rate(view, controller, gradient);
  const auto rate = [&](OptionalGradient<T> to) { return law_rate(view, controller, to); };
  if (!realization_of(view, controller).output_limit) return rate(gradient);
  const auto demand = [&](OptionalGradient<T> to) { return law_output(view, controller, to); };
  return saturated_rate(view.design.controllers[c].output_limit, demand, rate, gradient);
}

/// The rate of applied_effort() [N m/s or N/s].
template <class T>
T applied_effort_rate(const StateView<T>& view, const JointLoad& load, OptionalGradient<T> gradient) {
  const auto sum = [&](const auto& of_controller) {
    return [&view, &load, of_controller](OptionalGradient<T> to) {
      T total(0.0);
      for (int controller : load.controllers) total += of_controller(view, controller, to);
      return total;
    };
  };
  const auto rate = sum([](const StateView<T>& at, int c, OptionalGradient<T> to) { return drive_effort_rate(at, c, to); });
  if (!load.saturated) return rate(gradient);
  const auto demand = sum([](const StateView<T>& at, int c, OptionalGradient<T> to) { return drive_effort(at, c, to); });
  const T& limit = view.design.constants.pairs[static_cast<std::size_t>(load.pair)].dynamics[static_cast<std::size_t>(load.element)].effort;
  return saturated_rate(limit, demand, rate, gradient);
}

}  // namespace codesign

#endif  // MECHANISM_CODESIGN_ELEMENTS_EFFORT_RATE_H_
