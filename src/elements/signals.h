// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "description/formula.h"
#include "description/signal_table.h"
#include "elements/body_contact.h"
#include "elements/controllers.h"
#include "elements/effort_rate.h"
#include "elements/energy.h"
#include "elements/forest.h"
#include "elements/motor_signals.h"
#include "elements/reaction.h"
#include "elements/shaking.h"
#include "elements/state_view.h"
#include "math/arrays.h"
#include "math/euler_parameters.h"
#include "math/taylor.h"

namespace codesign {

// The values of signals, which controllers, objectives and observers read from a state. Each
// function returns one term without its factor, in the term's SI unit. The table of signals,
// description/signal_table.h, says which quantity is which value.

// A coordinate of a joint, theory (8), and its motor's side.

template <class T>
T joint_rate(const StateView<T>& view, const CoordinateIndex& of) {
  return view.coordinate(of.pair, of.element, CoordinateDetail::kRate).rate;
}
template <class T>
T joint_acceleration(const StateView<T>& view, const CoordinateIndex& of) {
  return view.coordinate(of.pair, of.element, CoordinateDetail::kAcceleration).acceleration;
}
template <class T>
T gear_ratio(const StateView<T>& view, const CoordinateIndex& of) {
  return view.dynamics(of.pair, of.element).gear_ratio;
}
template <class T>
CoordinateIndex motor_side(const StateView<T>& view, const CoordinateIndex& of) {
  return view.system.motor_of(of.pair, of.element);
}
template <class T>
T motor_position(const StateView<T>& view, const CoordinateIndex& of) {
  const CoordinateIndex motor = motor_side(view, of);
  return gear_ratio(view, of) * view.coordinate_value(motor.pair, motor.element);
}

// One component of the position, velocity or acceleration of a link's origin, or of its angular
// velocity or acceleration, in the term's axes.

template <class T>
const BodyKinematics<T>& body_of_link(const StateView<T>& view, const SignalReference& of) {
  return view.body(view.system.topology().link_body[to_index(of.link)]);
}
template <class T>
const Vector3<T>& origin_of_link(const StateView<T>& view, const SignalReference& of) {
  return view.design.constants.links[to_index(of.link)].s;
}
template <class T>
T link_position(const StateView<T>& view, const SignalReference& of) {
  const BodyKinematics<T>& k = body_of_link(view, of);
  return (k.r + k.A * origin_of_link(view, of))[of.axis];
}
template <class T>
T link_velocity(const StateView<T>& view, const SignalReference& of) {
  const BodyKinematics<T>& k = body_of_link(view, of);
  return component_of(view, of, Vector3<T>(k.rd + k.Ad * origin_of_link(view, of)));
}
template <class T>
T link_acceleration(const StateView<T>& view, const SignalReference& of) {
  const BodyKinematics<T>& k = body_of_link(view, of);
  return component_of(view, of, Vector3<T>(k.rdd + k.Add * origin_of_link(view, of)));
}
template <class T>
T link_angular_velocity(const StateView<T>& view, const SignalReference& of) {
  return component_of(view, of, ground_omega(body_of_link(view, of)));
}
template <class T>
T link_angular_acceleration(const StateView<T>& view, const SignalReference& of) {
  const BodyKinematics<T>& k = body_of_link(view, of);
  return component_of(view, of, Vector3<T>(k.A * body_alpha(k)));
}
/// r'' - g of the link's origin, which an accelerometer there shows; theory (11c).
template <class T>
T imu_acceleration(const StateView<T>& view, const SignalReference& of) {
  const BodyKinematics<T>& k = body_of_link(view, of);
  return component_of(view, of,
                      Vector3<T>(k.rdd + k.Add * origin_of_link(view, of) - view.design.gravity));
}
/// One component of a link's quaternion in the root's axes: the body's p times a constant
/// quaternion.
template <class T>
T link_orientation(const StateView<T>& view, const SignalReference& of) {
  const auto link = to_index(of.link);
  const Vector4<T> p = body_parameters(view.system, view.design.constants, *view.state,
                                       view.system.topology().link_body[link]);
  return quaternion_product<T>(p,
                               euler_parameters<T>(view.design.constants.links[link].R))[of.axis];
}

// Loads along a coordinate.

/// The sum of value(load) over the loads of a coordinate.
template <class T, class Value>
T sum_of_loads(const StateView<T>& view, const CoordinateIndex& at, Value&& value) {
  T sum(0.0);
  for (const JointLoad& load : view.system.loads())
    if (load.pair == at.pair && load.element == at.element) sum += value(load);
  return sum;
}
template <class T>
T joint_effort_rate(const StateView<T>& view, const CoordinateIndex& of) {
  return sum_of_loads(view, motor_side(view, of),
                      [&](const JointLoad& load) { return applied_effort_rate(view, load); });
}
/// Friction on the child, -L of theory (13).
template <class T>
T joint_friction(const StateView<T>& view, const CoordinateIndex& of) {
  return -sum_of_loads(view, of, [&](const JointLoad& load) {
    return load_of_kind(view, PowerKind::kFriction, load, joint_rate(view, of));
  });
}
/// What a gear and its motor lose, -L of (9b).
template <class T>
T joint_gear_loss(const StateView<T>& view, const CoordinateIndex& of) {
  const CoordinateIndex motor = motor_side(view, of);
  return -sum_of_loads(view, motor, [&](const JointLoad& load) {
    return gear_load(view, load, joint_rate(view, motor));
  });
}
template <class T>
T joint_gear_torque(const StateView<T>& view, const CoordinateIndex& of) {
  const CoordinateIndex motor = motor_side(view, of);
  return sum_of_loads(view, motor, [&](const JointLoad& load) {
    return gear_torque(view, load, joint_rate(view, motor));
  });
}

// A rigid gear has no deflection.

template <class T>
T gear_deflection_of(const StateView<T>& view, const CoordinateIndex& of) {
  const int gear = elastic_gear_of(view.system, of.pair, of.element);
  return gear < 0 ? T(0.0) : gear_deflection(view, gear);
}
template <class T>
T gear_deflection_rate_of(const StateView<T>& view, const CoordinateIndex& of) {
  const int gear = elastic_gear_of(view.system, of.pair, of.element);
  return gear < 0 ? T(0.0) : gear_deflection_rate(view, gear);
}
template <class T>
T elastic_torque_of(const StateView<T>& view, const CoordinateIndex& of) {
  const int gear = elastic_gear_of(view.system, of.pair, of.element);
  return gear < 0 ? T(0.0) : elastic_torque(view, gear);
}

// Controllers and spring-dampers.

template <class T>
auto controller_setpoint(const StateView<T>& view, const SignalReference& of) {
  return view.controller_numbers(of.controller).setpoint.at(view.state->t);
}
template <class T>
T controller_integral(const StateView<T>& view, const SignalReference& of) {
  return view.state->s[view.controller(of.controller).state];
}

/// Any term of a signal.
template <class T>
T term_value(const StateView<T>& view, const SignalReference& term) {
  T value(0.0);
  const auto set = [&](const auto& row) {
    if (row.facts.kind != term.kind) return false;
    value = row.value(view, term);
    return true;
  };
  std::apply([&](const auto&... rows) { return (set(rows) || ...); }, signal_table::kRows);
  return value;
}

/// An expression of signals, parameters and the time. @param number (value, value of its rate) ->
/// a Number; the rates are functions without arguments.
template <class Number, class T, class OfValueAndRate>
Number formula_of(const StateView<T>& view, const Signal& signal, const OfValueAndRate& number) {
  std::vector<Number> variables;
  variables.reserve(signal.formula->variables.size());
  for (const ResolvedFormula::Variable& variable : signal.formula->variables) {
    const auto of_term = [&](std::size_t first) {
      return term_value(view, signal[first + to_index(variable.term)]);
    };
    if (variable.term >= 0)
      variables.push_back(number(of_term(0), [&] { return of_term(signal.size() / 2); }));
    else if (variable.parameter)
      variables.push_back(
          number(value_at(*variable.parameter, view.design.parameters), [] { return T(0.0); }));
    else
      variables.push_back(number(view.design.clock.at(view.state->t).value, [] { return T(1.0); }));
  }
  const NamedSwitches<T> named(view.state->q[0], *signal.formula);
  return evaluate_formula<Number>(signal.formula->steps, variables);
}

template <class T>
T formula_value(const StateView<T>& view, const Signal& signal) {
  return formula_of<T>(view, signal, [](const T& value, const auto&) { return value; });
}

/// The time derivative of an expression, from the derivatives of the signals.
template <class T>
T formula_rate(const StateView<T>& view, const Signal& signal) {
  return formula_of<Taylor<T>>(view, signal,
                               [](const T& value, const auto& rate) {
                                 Taylor<T> x(value);
                                 x.c[1] = rate();
                                 return x;
                               })
      .c[1];
}

/// A signal, the sum of its terms times their factors, or an expression of them.
template <class T>
T signal_value(const StateView<T>& view, const Signal& signal) {
  if (signal.formula) {
    const T value = signal.is_rate ? formula_rate(view, signal) : formula_value(view, signal);
    note_expression(value);
    return value;
  }
  T sum(0.0);
  for (const SignalReference& term : signal) sum += T(term.factor) * term_value(view, term);
  return sum;
}

/// Signal minus reference.
template <class T>
T signal_error(const StateView<T>& view, const Signal& signal, const Reference<T>& moving) {
  return signal_value(view, signal) - moving.at(view.state->t).value;
}

/// What the loss of the k-th of these terms is a function of.
template <class T>
LossValues<T> loss_values(const StateView<T>& view, const std::vector<ResolvedTerm>& terms,
                          const ObjectiveNumbers<T>& numbers, std::size_t k) {
  const T reference = numbers.references[k].at(view.state->t).value;
  return {signal_value(view, terms[k].signal), reference, numbers.scales[k]};
}

/// The sum of weight rho(signal - reference) over terms of the objective: the integrand g or the
/// terminal terms w of theory (21).
template <class T>
T objective_terms(const StateView<T>& view, const std::vector<ResolvedTerm>& terms,
                  const ObjectiveNumbers<T>& numbers) {
  T sum(0.0);
  for (std::size_t k = 0; k < terms.size(); ++k) {
    const LossValues<T> values = loss_values(view, terms, numbers, k);
    const NamedSwitches<T> named(values.signal, terms[k]);
    sum += weighted_loss(*terms[k].loss, numbers.weights[k], values);
  }
  return sum;
}

/// Signal minus reference of the k-th watched signal, theory (21a).
template <class T>
T watched_value(const StateView<T>& view, std::size_t k) {
  return signal_error(view, view.system.watched()[k], view.design.watched[k]);
}

}  // namespace codesign
