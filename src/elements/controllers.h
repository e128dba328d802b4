// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "control/sampled_pid.h"
#include "elements/control_inputs.h"
#include "elements/state_view.h"
#include "forces/control_law.h"
#include "math/arrays.h"

// The control laws, theory (C1)-(C8) and (50).
namespace codesign {

/// The error e = r - x of a controller, setpoint minus filtered input, in the unit of its input;
/// zero for laws without an error.
template <class T>
T controller_error(const StateView<T>& view, int controller) {
  if (!view.controller(controller).kind->has_error()) return T(0.0);
  return view.controller_numbers(controller).setpoint.at(view.state->t).value -
         control_input(view, controller);
}

/// e' = r' - x' of (C3); x' is the exact derivative of the input.
template <class T>
T controller_error_rate(const StateView<T>& view, int controller) {
  return view.controller_numbers(controller).setpoint.at(view.state->t).rate -
         control_input_rate(view, controller);
}

/// What the derivative of a PID acts on, theory (C3): e, or -x with `derivative: measurement`.
template <class T>
T rated_error(const StateView<T>& view, int controller) {
  if (!realization_of(view, controller).rates_input) return controller_error(view, controller);
  return -control_input(view, controller);
}

/// Its rate: e', or -x'.
template <class T>
T rated_error_rate(const StateView<T>& view, int controller) {
  if (!realization_of(view, controller).rates_input) return controller_error_rate(view, controller);
  return -control_input_rate(view, controller);
}

/// The rate of the filtered error, (e - x) / tau of (50).
template <class T>
T filtered_error_rate(const StateView<T>& view, int controller) {
  const T per_tau = T(1.0) / view.controller_numbers(controller).derivative_filter;
  return per_tau *
         (rated_error(view, controller) - view.state->s[view.controller(controller).states.filter]);
}

/// Gains, error, integral and rate of (C3), (C5), (C6). i_clamp saturates k_i s if it bounds this
/// term and not the integral itself, (50).
template <class T>
ControlValues<T> error_values(const StateView<T>& view, int controller) {
  const Controller& resolved = view.controller(controller);
  const ControllerConstants<T>& k = view.controller_numbers(controller);
  const ControlRealization& realization = realization_of(view, controller);
  ControlValues<T> x;
  x.gains = k.pid;
  x.error = controller_error(view, controller);
  if (resolved.state >= 0) x.integral = view.state->s[resolved.state];
  if (resolved.states.filter >= 0)
    x.error_rate = filtered_error_rate(view, controller);
  else if (resolved.has_error_rate)
    x.error_rate = rated_error_rate(view, controller);
  const bool clamps_state = realization.antiwindup == AntiWindup::kClamping;
  if (!realization.i_clamp || clamps_state || resolved.state < 0) return x;
  x.clamped = saturate(T(k.pid.i * x.integral), k.i_clamp).value;
  x.integral = T(0.0);
  return x;
}

/// alpha_j = r'' + k_d e' + k_p e of (C6), the acceleration that a computed-torque controller
/// demands of its joint.
template <class T>
T wanted_acceleration(const StateView<T>& view, int controller) {
  const T acceleration =
      view.controller_numbers(controller).setpoint.at(view.state->t).acceleration;
  return acceleration + error_values(view, controller).pid();
}

/// u_k = tau_k(alpha) of (C6). The controllers of this kind form one law: alpha holds the
/// accelerations that all of them demand, and zero for joints without a demand. Motions are those
/// of the state; the turns of cut pairs follow from the axes of their bodies.
template <class T>
T computed_torque(const StateView<T>& view, int controller) {
  const std::vector<DrivenTree::Node>& nodes = view.controller(controller).tree.nodes;
  InverseDynamics<T>& dynamics = view.inverse_dynamics[to_index(controller)];
  for (std::size_t k = 0; k < nodes.size(); ++k) {
    const DrivenTree::Node& node = nodes[k];
    const Matrix3<T>& A_i = view.body(view.pair(node.pair).body_i).A;
    DrivenJoint<T>& joint = dynamics.joint(k);
    joint.pose = view.layout.is_cut(node.pair) ? joint_pose_of(A_i, view.body(node.body).A)
                                               : view.motion.poses[to_index(node.body)];
    if (node.slides) joint.position = view.coordinate_value(node.pair, 0);
    joint.rate = view.coordinate(node.pair, 0, CoordinateDetail::kRate).rate;
    joint.acceleration = node.controller < 0 ? T(0.0) : wanted_acceleration(view, node.controller);
  }
  return dynamics.load(view.design.constants, view.design.gravity);
}

/// u_0(t) - sum of K_i (x_i - r_i(t)), theory (C7).
template <class T>
T state_feedback(const StateView<T>& view, int controller) {
  const ControllerConstants<T>& k = view.controller_numbers(controller);
  T output = k.feedforward.at(view.state->t).value;
  for (std::size_t term = 0; term < k.gains.size(); ++term)
    output += k.gains[term] *
              (k.references[term].at(view.state->t).value - feedback_input(view, controller, term));
  return output;
}

/// The values that the law of a controller reads.
template <class T>
ControlValues<T> control_values(const StateView<T>& view, int controller) {
  const ControlLaw& law = *view.controller(controller).kind;
  ControlValues<T> x;
  if (law.has_error() && law.load != ControlLoad::kDemanded) x = error_values(view, controller);
  if (law.load == ControlLoad::kAtRest)
    x.load = gravity_load(view.controller(controller).tree, view.design.constants, view.kinematics,
                          view.design.gravity);
  if (law.load == ControlLoad::kDemanded) x.load = computed_torque(view, controller);
  if (law.input == ControlInput::kFeedback) x.given = state_feedback(view, controller);
  if (law.input == ControlInput::kShape)
    x.given = view.controller_numbers(controller).shape.at(view.state->t).value;
  if (law.input == ControlInput::kObserved) x.given = innovation(view, controller);
  return x;
}

/// The output of a continuous control law [unit of the output], before any limit.
template <class T>
T law_output(const StateView<T>& view, int controller) {
  return view.controller(controller).kind->output.template of<T>(control_values(view, controller));
}

/// The output of a continuous controller within output_limit, (50), and its derivative by the
/// output of the law.
template <class T>
SaturatedEffort<T> limited_output(const StateView<T>& view, int controller) {
  const T output = law_output(view, controller);
  const ControlRealization& realization = realization_of(view, controller);
  if (!realization.output_limit) return {output, T(1.0)};
  const Bounds<T>& limit = view.controller_numbers(controller).output_limit;
  if (!realization.limit_has_corners) return saturate(output, limit);
  const NamedSwitches<T> named(output, view.controller(controller));
  return cut(output, limit);
}

/// The output u of a controller [N or N m], positive along the coordinate that it drives, before
/// the actuator's limit (13c): of a sampled controller the held output, else the output of the law
/// within output_limit, (50).
template <class T>
T controller_output(const StateView<T>& view, int controller) {
  const int held = view.controller(controller).states.held;
  if (held >= 0) return view.state->s[held];
  return limited_output(view, controller).value;
}

/// The effort of the drive: the effort after its lag, (53), else the output itself.
template <class T>
T drive_effort(const StateView<T>& view, int controller) {
  const int lag = view.controller(controller).states.lag;
  return lag < 0 ? controller_output(view, controller) : T(view.state->s[lag]);
}

// The rows sigma - s' of the states of controllers, theory (50)-(53). The states of a sampled
// controller change only at its samples, so that its rows are sigma = 0.

/// s' of the integral of a controller.
template <class T>
T integral_rate(const StateView<T>& view, int controller) {
  const ControlRealization& realization = realization_of(view, controller);
  if (realization.is_sampled()) return T(0.0);
  const T error = controller_error(view, controller);
  const ControllerConstants<T>& k = view.controller_numbers(controller);
  switch (realization.antiwindup) {
    case AntiWindup::kNone:
      return error;
    case AntiWindup::kClamping:
      return clamped_integral_rate(error, T(view.state->s[view.controller(controller).state]),
                                   k.pid.i, k.i_clamp);
    case AntiWindup::kBackCalculation: {
      const T demand = law_output(view, controller);
      return error - tracked(T(demand - limited_output(view, controller).value), k.tracking);
    }
    case AntiWindup::kConditional: {
      const T demand = law_output(view, controller);
      const NamedSwitches<T> named(demand, view.controller(controller));
      return conditional_integral_rate(error, k.pid.i, demand, k.output_limit);
    }
  }
  return error;
}

/// f' = (u - f) / tau of the effort after the drive's lag, (53), of a continuous controller within
/// its rate_limit, (53a).
template <class T>
T lag_rate(const StateView<T>& view, int controller) {
  const int f = view.controller(controller).states.lag;
  const T per_tau = T(1.0) / view.controller_numbers(controller).time_constant;
  const T rate = per_tau * (controller_output(view, controller) - view.state->s[f]);
  const ControlRealization& realization = realization_of(view, controller);
  if (!realization.rate_limit || realization.is_sampled()) return rate;
  return saturate(rate, view.controller_numbers(controller).rate_limit).value;
}

/// The rates of an observer's estimates, theory (49a). @param set (state, rate)
template <class T, class Set>
void observer_residual(const StateView<T>& view, int controller, const Set& set) {
  const Controller& resolved = view.controller(controller);
  const JointObserver<T>& k = view.controller_numbers(controller).observer;
  const int first = resolved.states.estimate;
  const bool is_sampled = realization_of(view, controller).is_sampled();
  const T e = is_sampled ? T(0.0) : innovation(view, controller);
  T effort(0.0);
  for (const int other : resolved.efforts) effort += controller_output(view, other);
  if (resolved.states.estimates == 3) effort += estimate(view, controller, 2);
  set(first, T(estimate(view, controller, 1) + k.gains[0] * e));
  set(first + 1, T(effort / k.inertia + k.gains[1] * e));
  if (resolved.states.estimates == 3) set(first + 2, T(k.inertia * k.gains[2] * e));
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
  filter_residual(view, controller, set);
  if (states.filter >= 0)
    set(states.filter, realization.is_sampled() ? T(0.0) : filtered_error_rate(view, controller));
  if (states.last >= 0) set(states.last, T(0.0));
  if (states.held >= 0) set(states.held, T(0.0));
  if (states.computed >= 0) set(states.computed, T(0.0));
  for (int k = 0; k < realization.queued(); ++k) set(states.queue + k, T(0.0));
  if (states.lag >= 0) set(states.lag, lag_rate(view, controller));
  if (states.estimate >= 0) observer_residual(view, controller, set);
}

}  // namespace codesign
