// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "description/formula.h"
#include "elements/controllers.h"
#include "elements/effort_rate.h"
#include "elements/energy.h"
#include "elements/forest.h"
#include "elements/reaction.h"
#include "elements/state_view.h"
#include "math/arrays.h"
#include "math/euler_parameters.h"

namespace codesign {

// The values of signals, which controllers, objectives and observers read from a state. Each
// function returns one term without its factor, in the term's SI unit.

/// Position, velocity or acceleration of a joint coordinate, theory (8).
template <class T>
T joint_term(const StateView<T>& view, const SignalReference& term) {
  if (term.kind == SignalKind::kJointPosition)
    return view.coordinate_value(term.pair, term.element);
  if (term.kind == SignalKind::kJointAcceleration)
    return view.coordinate(term.pair, term.element, CoordinateDetail::kAcceleration).acceleration;
  return view.coordinate(term.pair, term.element, CoordinateDetail::kRate).rate;
}

/// One component of the position, velocity or acceleration of a link's origin, or of its angular
/// velocity, in ground axes.
template <class T>
T link_term(const StateView<T>& view, const SignalReference& term) {
  const BodyKinematics<T>& k = view.body(view.system.topology().link_body[to_index(term.link)]);
  const Vector3<T>& s = view.design.constants.links[to_index(term.link)].s;
  switch (term.kind) {
    case SignalKind::kLinkPosition:
      return (k.r + k.A * s)[term.axis];
    case SignalKind::kLinkAcceleration:
      return (k.rdd + k.Add * s)[term.axis];
    case SignalKind::kLinkAngularVelocity:
      return k.in_forest ? T(ground_omega(k)[term.axis])
                         : T(T(2.0) * (ground_rate_matrix(k.p) * k.pd)[term.axis]);
    default:
      return (k.rd + k.Ad * s)[term.axis];
  }
}

/// One component of a link's quaternion in the root's axes: the body's p times a constant
/// quaternion.
template <class T>
T orientation_term(const StateView<T>& view, const SignalReference& term) {
  const auto link = to_index(term.link);
  const Vector4<T> p = body_parameters(view.system, view.design.constants, *view.state,
                                       view.system.topology().link_body[link]);
  return quaternion_product<T>(p,
                               euler_parameters<T>(view.design.constants.links[link].R))[term.axis];
}

/// The effort of a joint or its rate, positive along its coordinate, its friction on the
/// child, -L of theory (13), the torque that its gear transmits, or what that loses, -L of (9b).
template <class T>
T load_term(const StateView<T>& view, const SignalReference& term) {
  if (term.kind == SignalKind::kJointEffort) return joint_effort(view, term.pair, term.element);
  const CoordinateIndex at = term.kind == SignalKind::kJointFriction
                                 ? CoordinateIndex{term.pair, term.element}
                                 : view.system.motor_of(term.pair, term.element);
  T sum(0.0);
  const auto rate = [&] {
    return T(view.coordinate(at.pair, at.element, CoordinateDetail::kRate).rate);
  };
  for (const JointLoad& load : view.system.loads()) {
    if (load.pair != at.pair || load.element != at.element) continue;
    if (term.kind == SignalKind::kJointEffortRate)
      sum += applied_effort_rate(view, load);
    else if (term.kind == SignalKind::kGearTorque)
      sum += gear_torque(view, load, rate());
    else if (term.kind == SignalKind::kGearLoss)
      sum -= gear_load(view, load, rate());
    else
      sum -= friction_load(view, load, rate());
  }
  return sum;
}

/// The powers of the whole mechanism, or of one joint, theory (14c).
template <class T>
T power_term(const StateView<T>& view, const SignalReference& term, PowerKind kind) {
  return term.pair < 0 ? total_power(view, kind) : joint_power(view, kind, term.pair, term.element);
}

/// Tension, length or its rate of a spring-damper, theory (13b).
template <class T>
T spring_term(const StateView<T>& view, const SignalReference& term) {
  const auto spring = to_index(term.spring);
  if (term.kind == SignalKind::kSpringSpeed) return spring_speed(view, spring);
  const SpringForce<T> force = spring_at(view, spring);
  return term.kind == SignalKind::kSpringForce ? force.tension : force.length;
}

/// Torque, position, speed or acceleration of the actuator of a joint, on the motor's side of its
/// gear.
template <class T>
T motor_term(const StateView<T>& view, const SignalReference& term) {
  const T& ratio = view.dynamics(term.pair, term.element).gear_ratio;
  const CoordinateIndex motor = view.system.motor_of(term.pair, term.element);
  switch (term.kind) {
    case SignalKind::kMotorTorque:
      return joint_effort(view, term.pair, term.element) / ratio;
    case SignalKind::kMotorPosition:
      return ratio * view.coordinate_value(motor.pair, motor.element);
    case SignalKind::kMotorAcceleration:
      return ratio * view.coordinate(motor.pair, motor.element, CoordinateDetail::kAcceleration)
                         .acceleration;
    default:
      return ratio * view.coordinate(motor.pair, motor.element, CoordinateDetail::kRate).rate;
  }
}

/// Deflection of a gear, its rate, or the torque of an elastic one; a rigid gear has none.
template <class T>
T elastic_term(const StateView<T>& view, const SignalReference& term) {
  const int gear = elastic_gear_of(view.system, term.pair, term.element);
  if (gear < 0) return T(0.0);
  switch (term.kind) {
    case SignalKind::kElasticTorque:
      return elastic_torque(view, gear);
    case SignalKind::kGearDeflectionRate:
      return gear_deflection_rate(view, gear);
    default:
      return gear_deflection(view, gear);
  }
}

/// A value of a controller.
template <class T>
T controller_term(const StateView<T>& view, const SignalReference& term) {
  switch (term.kind) {
    case SignalKind::kControllerError:
      return controller_error(view, term.controller);
    case SignalKind::kControllerOutput:
      return controller_output(view, term.controller);
    case SignalKind::kControllerErrorRate:
      return controller_error_rate(view, term.controller);
    case SignalKind::kControllerSetpoint:
      return view.controller_numbers(term.controller).setpoint.at(view.state->t).value;
    case SignalKind::kControllerSetpointRate:
      return view.controller_numbers(term.controller).setpoint.at(view.state->t).rate;
    default:
      return view.state->s[view.controller(term.controller).state];
  }
}

inline bool is_of_elastic_gear(SignalKind kind) {
  return kind == SignalKind::kGearDeflection || kind == SignalKind::kGearDeflectionRate ||
         kind == SignalKind::kElasticTorque;
}

/// Any term of a signal.
template <class T>
T term_value(const StateView<T>& view, const SignalReference& term) {
  if (is_of_elastic_gear(term.kind)) return elastic_term(view, term);
  switch (term.kind) {
    case SignalKind::kLinkPosition:
    case SignalKind::kLinkVelocity:
    case SignalKind::kLinkAcceleration:
    case SignalKind::kLinkAngularVelocity:
      return link_term(view, term);
    case SignalKind::kControllerError:
    case SignalKind::kControllerOutput:
    case SignalKind::kControllerErrorRate:
    case SignalKind::kControllerSetpoint:
    case SignalKind::kControllerSetpointRate:
    case SignalKind::kControllerIntegral:
      return controller_term(view, term);
    case SignalKind::kContactFriction:
      return -contact_at(view, term.pair).magnitude();
    case SignalKind::kContactSpeed:
      return contact_at(view, term.pair).speed();
    case SignalKind::kLinkOrientation:
      return orientation_term(view, term);
    case SignalKind::kReactionForce:
    case SignalKind::kReactionTorque:
      return reaction_term(view, term);
    case SignalKind::kKineticEnergy:
      return kinetic_energy(view);
    case SignalKind::kPotentialEnergy:
      return potential_energy(view);
    case SignalKind::kTotalEnergy:
      return kinetic_energy(view) + potential_energy(view);
    case SignalKind::kFrictionPower:
      return power_term(view, term, PowerKind::kFriction);
    case SignalKind::kDampingPower:
      return power_term(view, term, PowerKind::kDamping);
    case SignalKind::kActuatorPower:
      return power_term(view, term, PowerKind::kActuator);
    case SignalKind::kLoadPower:
      return power_term(view, term, PowerKind::kLoad);
    case SignalKind::kJointEffort:
    case SignalKind::kJointEffortRate:
    case SignalKind::kJointFriction:
    case SignalKind::kGearTorque:
    case SignalKind::kGearLoss:
      return load_term(view, term);
    case SignalKind::kJointNormalForce:
      return normal_force(view, term.pair);
    case SignalKind::kSpringForce:
    case SignalKind::kSpringLength:
    case SignalKind::kSpringSpeed:
      return spring_term(view, term);
    case SignalKind::kMotorTorque:
    case SignalKind::kMotorSpeed:
    case SignalKind::kMotorPosition:
    case SignalKind::kMotorAcceleration:
      return motor_term(view, term);
    default:
      return joint_term(view, term);
  }
}

/// An expression of signals, parameters and the time.
template <class T>
T formula_value(const StateView<T>& view, const Signal& signal) {
  std::vector<T> variables;
  variables.reserve(signal.formula->variables.size());
  for (const ResolvedFormula::Variable& variable : signal.formula->variables)
    variables.push_back(variable.term >= 0   ? term_value(view, signal[to_index(variable.term)])
                        : variable.parameter ? value_at(*variable.parameter, view.design.parameters)
                                             : view.design.clock.at(view.state->t).value);
  return evaluate_formula<T>(signal.formula->steps, variables);
}

/// A signal, the sum of its terms times their factors, or an expression of them.
template <class T>
T signal_value(const StateView<T>& view, const Signal& signal) {
  if (signal.formula) return formula_value(view, signal);
  T sum(0.0);
  for (const SignalReference& term : signal) sum += T(term.factor) * term_value(view, term);
  return sum;
}

/// Signal minus reference.
template <class T>
T signal_error(const StateView<T>& view, const Signal& signal, const Reference<T>& moving) {
  return signal_value(view, signal) - moving.at(view.state->t).value;
}

/// The sum of weight (signal - reference)^2 over terms of the objective: the integrand g or the
/// terminal terms w of theory (21).
template <class T>
T objective_terms(const StateView<T>& view, const std::vector<ResolvedTerm>& terms,
                  const ObjectiveNumbers<T>& numbers) {
  T sum(0.0);
  for (std::size_t k = 0; k < terms.size(); ++k) {
    const T error = signal_error(view, terms[k].signal, numbers.references[k]);
    sum += numbers.weights[k] * error * error;
  }
  return sum;
}

/// Signal minus reference of the k-th watched signal, theory (21a).
template <class T>
T watched_value(const StateView<T>& view, std::size_t k) {
  return signal_error(view, view.system.watched()[k], view.design.watched[k]);
}

}  // namespace codesign
