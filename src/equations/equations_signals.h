// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_EQUATIONS_EQUATIONS_SIGNALS_H_
#define MECHANISM_CODESIGN_EQUATIONS_EQUATIONS_SIGNALS_H_

#include "equations/equations.h"

namespace codesign {

template <class T>
T Equations<T>::joint_term(const SignalReference& term, const T& factor, SparseGradient<T>* gradient) {
  const bool position = term.kind == SignalKind::kJointPosition;
  if (position && !gradient) return factor * coordinate_value(term.pair, term.element);
  const bool rate_alone = !gradient && term.kind != SignalKind::kJointAcceleration;
  const CoordinateMotion<T>& m = coordinate(term.pair, term.element,
                                            position     ? CoordinateDetail::kAll
                                            : rate_alone ? CoordinateDetail::kRate
                                                         : CoordinateDetail::kGradient);
  const bool with_r = coordinate_moves_r(term.pair, term.element);
  switch (term.kind) {
    case SignalKind::kJointPosition:
      if (gradient) append_local(term.pair, m.position_q, factor, with_r, &gradient->position);
      return factor * m.position;
    case SignalKind::kJointAcceleration:
      if (gradient) append_acceleration(term.pair, term.element, m, factor, gradient);
      return factor * m.acceleration;
    default:
      if (gradient) append_rate(term.pair, term.element, m, factor, gradient);
      return factor * m.rate;
  }
}

template <class T>
T Equations<T>::link_term(const SignalReference& term, const T& factor, SparseGradient<T>* gradient) {
  const int index = system_.topology().link_body[static_cast<std::size_t>(term.link)], c = kBodySize * index;
  const BodyKinematics<T>& k = body(index);
  const Vector3<T>& s = constants_.links[static_cast<std::size_t>(term.link)].s;
  const bool turning = term.kind == SignalKind::kLinkAngularVelocity;
  const int order = term.kind == SignalKind::kLinkPosition ? 0 : term.kind == SignalKind::kLinkAcceleration ? 2 : 1;
  if (gradient && index >= 0) {
    typename SparseGradient<T>::Entries* const variables[3] = {&gradient->position, &gradient->velocity, &gradient->rate};
    if (!turning) variables[order]->push_back({c + term.axis, factor});
    // The value is linear in the highest derivative of p, with B0; each lower one has the binomial coefficient.
    const Matrix34<T> B0 = turning ? Matrix34<T>(2.0 * ground_rate_matrix(k.p)) : rotated_vector_jacobian(k.p, s);
    const Matrix34<T> B1 = turning ? Matrix34<T>(T(-2.0) * ground_rate_matrix(k.pd)) : rotated_vector_jacobian(k.pd, s);
    const Matrix34<T> B2 = rotated_vector_jacobian(k.pdd, s);
    for (int e = 0; e < 4; ++e) {
      const int column = c + 3 + e;
      variables[order]->push_back({column, T(factor * B0(term.axis, e))});
      if (order >= 1) variables[order - 1]->push_back({column, T(T(order) * factor * B1(term.axis, e))});
      if (order == 2) variables[0]->push_back({column, T(factor * B2(term.axis, e))});
    }
  }
  if (turning) return factor * 2.0 * (ground_rate_matrix(k.p) * k.pd)[term.axis];
  const Vector3<T> x = order == 0 ? k.r + k.A * s : order == 1 ? k.rd + k.Ad * s : k.rdd + k.Add * s;
  return factor * x[term.axis];
}

template <class T>
T Equations<T>::term_value(const SignalReference& term, const T& factor, SparseGradient<T>* gradient) {
  const auto before = mark(gradient);
  switch (term.kind) {
    case SignalKind::kLinkPosition:
    case SignalKind::kLinkVelocity:
    case SignalKind::kLinkAcceleration:
    case SignalKind::kLinkAngularVelocity:
      return link_term(term, factor, gradient);
    case SignalKind::kControllerError: {
      const T value = controller_error(term.controller, gradient);
      if (gradient) gradient->scale_from(before, factor);
      return factor * value;
    }
    case SignalKind::kControllerErrorRate:
      return controller_error_rate(term.controller, factor, gradient);
    case SignalKind::kControllerOutput: {
      const T value = controller_output(term.controller, gradient);
      if (gradient) gradient->scale_from(before, factor);
      return factor * value;
    }
    case SignalKind::kControllerIntegral: {
      const int s = system_.controllers()[static_cast<std::size_t>(term.controller)].state;
      if (gradient) gradient->position.push_back({layout_.position_column(s), factor});
      return factor * state_->s[s];
    }
    case SignalKind::kContactFriction:
    case SignalKind::kContactSpeed:
      return contact_term(term, factor, gradient);
    case SignalKind::kLinkOrientation:
      return orientation_term(term, factor, gradient);
    case SignalKind::kReactionForce:
    case SignalKind::kReactionTorque:
      return reaction_term(term, factor, gradient);
    case SignalKind::kKineticEnergy:
    case SignalKind::kPotentialEnergy:
    case SignalKind::kTotalEnergy:
    case SignalKind::kFrictionPower:
    case SignalKind::kDampingPower:
    case SignalKind::kActuatorPower:
    case SignalKind::kLoadPower: {
      const T value = energy_or_power(term, gradient);
      if (gradient) gradient->scale_from(before, factor);
      return factor * value;
    }
    case SignalKind::kJointEffort:
    case SignalKind::kJointFriction:
      return load_term(term, factor, gradient);
    case SignalKind::kJointNormalForce: {
      const NormalForce<T> N = normal_force(term.pair);
      if (gradient) append_normal_gradient(term.pair, N.F, N.torque, factor, gradient);
      return factor * N.value;
    }
    default:
      return joint_term(term, factor, gradient);
  }
}

template <class T>
T Equations<T>::energy_or_power(const SignalReference& term, SparseGradient<T>* gradient) {
  const auto power_of = [&](PowerKind kind) {
    return term.pair < 0 ? power(kind, gradient) : joint_power(kind, term.pair, term.element, gradient);
  };
  switch (term.kind) {
    case SignalKind::kKineticEnergy:
      return kinetic_energy(gradient);
    case SignalKind::kPotentialEnergy:
      return potential_energy(gradient);
    case SignalKind::kFrictionPower:
      return power_of(PowerKind::kFriction);
    case SignalKind::kDampingPower:
      return power_of(PowerKind::kDamping);
    case SignalKind::kActuatorPower:
      return power_of(PowerKind::kActuator);
    case SignalKind::kLoadPower:
      return power_of(PowerKind::kLoad);
    default:
      break;
  }
  // In this order for every scalar, as the gradient's entries are found again by it.
  const T kinetic = kinetic_energy(gradient);
  return kinetic + potential_energy(gradient);
}

// The link's quaternion is that of its body times a constant one, so that it is linear in p.
template <class T>
T Equations<T>::orientation_term(const SignalReference& term, const T& factor, SparseGradient<T>* gradient) {
  const int index = system_.topology().link_body[static_cast<std::size_t>(term.link)];
  const BodyKinematics<T>& k = body(index);
  const Vector4<T> in_body = euler_parameters<T>(constants_.links[static_cast<std::size_t>(term.link)].R);
  T value(0.0);
  for (int e = 0; e < 4; ++e) {
    const T by_p = quaternion_product<T>(Vector4<T>(Vector4<T>::Unit(e)), in_body)[term.axis];
    value += by_p * k.p[e];
    if (gradient && index >= 0) gradient->position.push_back({kBodySize * index + 3 + e, T(factor * by_p)});
  }
  return factor * value;
}

template <class T>
T Equations<T>::load_term(const SignalReference& term, const T& factor, SparseGradient<T>* gradient) {
  T sum(0.0);
  for (const JointLoad& load : system_.loads()) {
    if (load.pair != term.pair || load.element != term.element) continue;
    const auto before = mark(gradient);
    if (term.kind == SignalKind::kJointEffort) {
      sum += factor * applied_effort(load, gradient);
      if (gradient) gradient->scale_from(before, factor);
      continue;
    }
    // A copy without the list of controllers takes no memory.
    JointLoad friction;
    friction.pair = load.pair;
    friction.element = load.element;
    friction.reaction_friction = load.reaction_friction;
    friction.constant_friction = load.constant_friction;
    const CoordinateMotion<T>& motion =
        coordinate(term.pair, term.element, gradient ? CoordinateDetail::kGradient : CoordinateDetail::kRate);
    sum -= factor * joint_load(friction, motion, gradient);
    if (gradient) gradient->scale_from(before, T(-factor));
  }
  return sum;
}

template <class T>
T Equations<T>::signal_value(const Signal& signal, const T& factor, SparseGradient<T>* gradient) {
  T sum(0.0);
  for (const SignalReference& term : signal) sum += term_value(term, T(T(term.factor) * factor), gradient);
  return sum;
}

template <class T>
T Equations<T>::signal(const Signal& signal, const State<T>& state, SparseGradient<T>* gradient) {
  load(state);
  return signal_value(signal, T(1.0), gradient);
}

template <class T>
T Equations<T>::objective_terms(const std::vector<ResolvedTerm>& terms, const std::vector<T>& weights,
                                const std::vector<Reference<T>>& references, SparseGradient<T>* gradient) {
  T sum(0.0);
  for (std::size_t k = 0; k < terms.size(); ++k) {
    const auto before = mark(gradient);
    const ReferenceMotion<T> reference = references[k].at(state_->t);
    const T error = signal_value(terms[k].signal, T(1.0), gradient) - reference.value;
    if (gradient) gradient->time -= reference.rate;
    sum += weights[k] * error * error;
    if (gradient) gradient->scale_from(before, T(2.0 * weights[k] * error));
  }
  return sum;
}

template <class T>
T Equations<T>::terminal(const State<T>& state, SparseGradient<T>* gradient) {
  load(state);
  return objective_terms(system_.terminal(), terminal_weights_, terminal_references_, gradient);
}

}  // namespace codesign

#endif  // MECHANISM_CODESIGN_EQUATIONS_EQUATIONS_SIGNALS_H_
