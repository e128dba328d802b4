// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_ELEMENTS_CONTROLLERS_H_
#define MECHANISM_CODESIGN_ELEMENTS_CONTROLLERS_H_

#include "control/clamp.h"
#include "control/pid.h"
#include "elements/gradient_rows.h"
#include "elements/state_view.h"
#include "elements/workspace.h"
#include "forces/saturation.h"
#include "math/span.h"

namespace codesign {

// The control laws, theory (C1)-(C8) and (50). Each function returns a value and, if `gradient` is not null, appends its gradient by
// positions, velocities, rates (multipliers and accelerations included) and time; the part by time comes from moving setpoints and inputs.

// Defined in elements/signals.h. Declared here because controllers read signals and signals read controllers.
template <class T>
T signal_value(const StateView<T>& view, const Signal& signal, const T& factor, OptionalGradient<T> gradient);

/// The error e = r - x of a controller, setpoint minus input, in the unit of its input; zero for laws without an error. Appends its
/// gradient.
template <class T>
T controller_error(const StateView<T>& view, int controller, OptionalGradient<T> gradient) {
  const auto c = static_cast<std::size_t>(controller);
  if (!has_error(view.system.controllers()[c].kind)) return T(0.0);
  const ReferenceMotion<T> setpoint = view.design.controllers[c].setpoint.at(view.state->t);
  if (gradient) gradient->time += setpoint.rate;
  return setpoint.value + signal_value(view, view.system.controllers()[c].input, T(-1.0), gradient);
}

/// factor times e' = r' - x' of (C3); x' is the signal's exact derivative. Appends its gradient.
template <class T>
T controller_error_rate(const StateView<T>& view, int controller, const T& factor, OptionalGradient<T> gradient) {
  const auto c = static_cast<std::size_t>(controller);
  const ReferenceMotion<T> setpoint = view.design.controllers[c].setpoint.at(view.state->t);
  if (gradient) gradient->time += factor * setpoint.acceleration;
  return factor * setpoint.rate + signal_value(view, view.system.controllers()[c].input_rate, T(-factor), gradient);
}

/// factor times the setpoint r of a controller, in the unit of its input; with `order` 1 factor times r'. Appends its derivative by time.
template <class T>
T controller_setpoint(const StateView<T>& view, int controller, int order, const T& factor, OptionalGradient<T> gradient) {
  const ReferenceMotion<T> setpoint = view.design.controllers[static_cast<std::size_t>(controller)].setpoint.at(view.state->t);
  if (gradient) gradient->time += factor * (order == 0 ? setpoint.rate : setpoint.acceleration);
  return factor * (order == 0 ? setpoint.value : setpoint.rate);
}

/// How a robot runs a controller.
template <class T>
const ControlRealization& realization_of(const StateView<T>& view, int controller) {
  return view.system.study().controllers[static_cast<std::size_t>(controller)].realization;
}

/// The rate of the filtered error, (e - x) / tau of (50). Appends its gradient.
template <class T>
T filtered_error_rate(const StateView<T>& view, int controller, OptionalGradient<T> gradient) {
  const int x = view.system.controllers()[static_cast<std::size_t>(controller)].states.filter;
  const T per_tau = T(1.0) / view.design.controllers[static_cast<std::size_t>(controller)].derivative_filter;
  const auto before = mark(gradient);
  const T error = controller_error(view, controller, gradient);
  if (gradient) {
    gradient->scale_from(before, per_tau);
    gradient->position.push_back({view.layout.position_column(x), T(-per_tau)});
  }
  return per_tau * (error - view.state->s[x]);
}

/// k_i s of a continuous controller, saturated by i_clamp if i_clamp bounds this term and not the integral itself, (50). Appends its
/// gradient.
template <class T>
T clamped_integral_term(const StateView<T>& view, int controller, OptionalGradient<T> gradient) {
  const auto c = static_cast<std::size_t>(controller);
  const ControllerConstants<T>& k = view.design.controllers[c];
  const int s = view.system.controllers()[c].state;
  const SaturatedEffort<T> term = saturate(T(k.pid.i * view.state->s[s]), k.i_clamp);
  if (gradient) gradient->position.push_back({view.layout.position_column(s), T(term.slope * k.pid.i)});
  return term.value;
}

/// u = k_p e + k_i s + k_d e' of (C3), also the feedback part of (C5) and (C6). Appends its gradient.
template <class T>
T pid_output(const StateView<T>& view, int controller, OptionalGradient<T> gradient) {
  const Controller& resolved = view.system.controllers()[static_cast<std::size_t>(controller)];
  const Pid<T>& law = view.design.controllers[static_cast<std::size_t>(controller)].pid;
  auto before = mark(gradient);
  const T error = controller_error(view, controller, gradient);
  if (gradient) gradient->scale_from(before, law.p);
  T integral(0.0), error_rate(0.0), clamped(0.0);
  const ControlRealization& realization = realization_of(view, controller);
  const bool clamps_term = realization.i_clamp && !realization.antiwindup && resolved.state >= 0;
  if (clamps_term) {
    clamped = clamped_integral_term(view, controller, gradient);
  } else if (resolved.state >= 0) {
    integral = view.state->s[resolved.state];
    if (gradient) gradient->position.push_back({view.layout.position_column(resolved.state), law.i});
  }
  const bool filtered = resolved.states.filter >= 0;
  if (filtered || !resolved.input_rate.empty()) {
    before = mark(gradient);
    error_rate = filtered ? filtered_error_rate(view, controller, gradient) : controller_error_rate(view, controller, T(1.0), gradient);
    if (gradient) gradient->scale_from(before, law.d);
  }
  const T output = law.output(error, integral, error_rate);
  return clamps_term ? T(output + clamped) : output;
}

/// The load tau_k of (C4) [N or N m] along the coordinate that the controller drives. Appends its gradient by positions and velocities, and
/// writes its derivatives by the accelerations and rates of the nodes to ControlMemory::by_acceleration and by_rate; the caller applies
/// them.
/// @param accelerations one per node of the driven tree, or none for (C5): everything at rest. With accelerations the caller must fill
/// ControlMemory::rates before.
template <class T>
T inverse_dynamics_load(const StateView<T>& view, int controller, In<T> accelerations, OptionalGradient<T> gradient) {
  const auto c = static_cast<std::size_t>(controller);
  // ControlMemory has room for the largest tree.
  const auto nodes = static_cast<std::ptrdiff_t>(view.system.controllers()[c].tree.nodes.size());
  const T load = view.control.inverse_dynamics[c].load(view.design.constants, view.kinematics, view.design.gravity, accelerations,
                                                       In<T>(view.control.rates).first(nodes));
  if (gradient)
    view.control.inverse_dynamics[c].append_gradient(T(1.0), gradient, Out<T>(view.control.by_acceleration).first(nodes),
                                                     Out<T>(view.control.by_rate).first(nodes));
  return load;
}

/// alpha_j = r'' + k_d e' + k_p e of (C6), the acceleration that a computed-torque controller demands of its joint. Appends its gradient.
template <class T>
T wanted_acceleration(const StateView<T>& view, int controller, OptionalGradient<T> gradient) {
  const ReferenceMotion<T> setpoint = view.design.controllers[static_cast<std::size_t>(controller)].setpoint.at(view.state->t);
  if (gradient) gradient->time += setpoint.jerk;
  return setpoint.acceleration + pid_output(view, controller, gradient);
}

/// u_k = tau_k(alpha) of (C6). The controllers of this kind form one law: alpha holds the accelerations that all of them demand, and zero
/// for joints without a demand. Appends its gradient.
template <class T>
T computed_torque(const StateView<T>& view, int controller, OptionalGradient<T> gradient) {
  const std::vector<DrivenTree::Node>& nodes = view.system.controllers()[static_cast<std::size_t>(controller)].tree.nodes;
  for (std::size_t k = 0; k < nodes.size(); ++k)
    view.control.accelerations[k] = nodes[k].controller < 0 ? T(0.0) : wanted_acceleration(view, nodes[k].controller, nullptr);
  const CoordinateDetail detail = gradient ? CoordinateDetail::kGradient : CoordinateDetail::kRate;
  for (std::size_t k = 0; k < nodes.size(); ++k)
    if (nodes[k].rotor) view.control.rates[k] = view.coordinate(nodes[k].pair, 0, detail).rate;
  const T load =
      inverse_dynamics_load(view, controller, In<T>(view.control.accelerations).first(static_cast<std::ptrdiff_t>(nodes.size())), gradient);
  for (std::size_t k = 0; gradient && k < nodes.size(); ++k) {
    if (nodes[k].controller < 0) continue;
    const auto before = mark(gradient);
    wanted_acceleration(view, nodes[k].controller, gradient);
    gradient->scale_from(before, view.control.by_acceleration[k]);
  }
  for (std::size_t k = 0; gradient && k < nodes.size(); ++k)
    if (nodes[k].rotor) append_rate(view, nodes[k].pair, 0, view.coordinate(nodes[k].pair, 0, detail), view.control.by_rate[k], gradient);
  return load;
}

/// u = u_0(t) - sum of K_i (x_i - r_i(t)), theory (C7). Appends its gradient.
template <class T>
T state_feedback(const StateView<T>& view, int controller, OptionalGradient<T> gradient) {
  const auto c = static_cast<std::size_t>(controller);
  const ControllerConstants<T>& k = view.design.controllers[c];
  const ReferenceMotion<T> feedforward = k.feedforward.at(view.state->t);
  T output = feedforward.value;
  if (gradient) gradient->time += feedforward.rate;
  for (std::size_t term = 0; term < k.gains.size(); ++term) {
    const ReferenceMotion<T> reference = k.references[term].at(view.state->t);
    output +=
        k.gains[term] * reference.value + signal_value(view, view.system.controllers()[c].feedback[term], T(-k.gains[term]), gradient);
    if (gradient) gradient->time += k.gains[term] * reference.rate;
  }
  return output;
}

/// u(t) of (C8). Appends its derivative by time.
template <class T>
T shaped_input(const StateView<T>& view, int controller, OptionalGradient<T> gradient) {
  const ReferenceMotion<T> input = view.design.controllers[static_cast<std::size_t>(controller)].shape.at(view.state->t);
  if (gradient) gradient->time += input.rate;
  return input.value;
}

/// The output of a continuous control law [unit of the output], before any limit. Appends its gradient.
template <class T>
T law_output(const StateView<T>& view, int controller, OptionalGradient<T> gradient) {
  switch (view.system.controllers()[static_cast<std::size_t>(controller)].kind) {
    case ControllerKind::kPid:
      return pid_output(view, controller, gradient);
    case ControllerKind::kPdGravity: {
      // Two statements, because the order in which entries are appended must not depend on the compiler: an assembly is recorded once.
      const T feedback = pid_output(view, controller, gradient);
      return feedback + inverse_dynamics_load(view, controller, {}, gradient);
    }
    case ControllerKind::kComputedTorque:
      return computed_torque(view, controller, gradient);
    case ControllerKind::kStateFeedback:
      return state_feedback(view, controller, gradient);
    case ControllerKind::kBasis:
      break;
  }
  return shaped_input(view, controller, gradient);
}

/// The output u of a controller [N or N m], positive along the coordinate that it drives, before the actuator's limit (13c): of a sampled
/// controller the held output, else the output of the law within output_limit, (50). Appends its gradient.
template <class T>
T controller_output(const StateView<T>& view, int controller, OptionalGradient<T> gradient) {
  const int held = view.system.controllers()[static_cast<std::size_t>(controller)].states.held;
  if (held >= 0) {
    if (gradient) gradient->position.push_back({view.layout.position_column(held), T(1.0)});
    return view.state->s[held];
  }
  const auto before = mark(gradient);
  const T output = law_output(view, controller, gradient);
  if (!realization_of(view, controller).output_limit) return output;
  const SaturatedEffort<T> limited = saturate(output, view.design.controllers[static_cast<std::size_t>(controller)].output_limit);
  if (gradient) gradient->scale_from(before, limited.slope);
  return limited.value;
}

/// The effort of the drive: the effort after its lag, (53), else the output itself. Appends its gradient.
template <class T>
T drive_effort(const StateView<T>& view, int controller, OptionalGradient<T> gradient) {
  const int lag = view.system.controllers()[static_cast<std::size_t>(controller)].states.lag;
  if (lag < 0) return controller_output(view, controller, gradient);
  if (gradient) gradient->position.push_back({view.layout.position_column(lag), T(1.0)});
  return view.state->s[lag];
}

}  // namespace codesign

#endif  // MECHANISM_CODESIGN_ELEMENTS_CONTROLLERS_H_
