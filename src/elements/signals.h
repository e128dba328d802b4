// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_ELEMENTS_SIGNALS_H_
#define MECHANISM_CODESIGN_ELEMENTS_SIGNALS_H_

#include "elements/controllers.h"
#include "elements/effort_rate.h"
#include "elements/energy.h"
#include "elements/gradient_rows.h"
#include "elements/power.h"
#include "elements/reaction.h"
#include "elements/state_view.h"
#include "math/euler_parameters.h"

namespace codesign {

// The values of signals, which controllers, objectives and observers read from a state. Each function returns factor times one term, in the
// term's SI unit, and appends factor times its gradient if `gradient` is not null.

/// Position, velocity or acceleration of a joint coordinate, theory (8).
template <class T>
T joint_term(const StateView<T>& view, const SignalReference& term, const T& factor, OptionalGradient<T> gradient) {
  const bool position = term.kind == SignalKind::kJointPosition;
  if (position && !gradient) return factor * view.coordinate_value(term.pair, term.element);
  const bool rate_alone = !gradient && term.kind != SignalKind::kJointAcceleration;
  const CoordinateMotion<T>& m = view.coordinate(term.pair, term.element,
                                                 position     ? CoordinateDetail::kAll
                                                 : rate_alone ? CoordinateDetail::kRate
                                                              : CoordinateDetail::kGradient);
  const bool with_r = view.coordinate_moves_r(term.pair, term.element);
  switch (term.kind) {
    case SignalKind::kJointPosition:
      if (gradient) append_local(view, term.pair, m.position_q, factor, with_r, &gradient->position);
      return factor * m.position;
    case SignalKind::kJointAcceleration:
      if (gradient) append_acceleration(view, term.pair, term.element, m, factor, gradient);
      return factor * m.acceleration;
    default:
      if (gradient) append_rate(view, term.pair, term.element, m, factor, gradient);
      return factor * m.rate;
  }
}

/// One component of the position, velocity or acceleration of a link's origin, or of its angular velocity, in ground axes.
template <class T>
T link_term(const StateView<T>& view, const SignalReference& term, const T& factor, OptionalGradient<T> gradient) {
  const int index = view.system.topology().link_body[static_cast<std::size_t>(term.link)], c = kBodySize * index;
  const BodyKinematics<T>& k = view.body(index);
  const Vector3<T>& s = view.design.constants.links[static_cast<std::size_t>(term.link)].s;
  const bool turning = term.kind == SignalKind::kLinkAngularVelocity;
  const int order = term.kind == SignalKind::kLinkPosition ? 0 : term.kind == SignalKind::kLinkAcceleration ? 2 : 1;
  if (gradient && index >= 0) {
    typename SparseGradient<T>::Entries* const variables[3] = {&gradient->position, &gradient->velocity, &gradient->rate};
    if (!turning) variables[order]->push_back({c + term.axis, factor});
    // x = A(p) s has x' = B(p) p' and x'' = B(p) p'' + B(p') p' with B linear. So the derivative of x^(n) by p^(k) is the binomial
    // coefficient (n over k) times B(p^(n-k)); likewise omega = 2 E(p) p', with -2 E(p') as its derivative by p.
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

/// One component of a link's quaternion in the root's axes. It is the body's p times a constant quaternion, so the term is linear in p.
template <class T>
T orientation_term(const StateView<T>& view, const SignalReference& term, const T& factor, OptionalGradient<T> gradient) {
  const int index = view.system.topology().link_body[static_cast<std::size_t>(term.link)];
  const BodyKinematics<T>& k = view.body(index);
  const Vector4<T> in_body = euler_parameters<T>(view.design.constants.links[static_cast<std::size_t>(term.link)].R);
  T value(0.0);
  for (int e = 0; e < 4; ++e) {
    const T by_p = quaternion_product<T>(Vector4<T>(Vector4<T>::Unit(e)), in_body)[term.axis];
    value += by_p * k.p[e];
    if (gradient && index >= 0) gradient->position.push_back({kBodySize * index + 3 + e, T(factor * by_p)});
  }
  return factor * value;
}

/// The applied effort of a joint or its rate, positive along its coordinate, or its friction on the child, -L of theory (13).
template <class T>
T load_term(const StateView<T>& view, const SignalReference& term, const T& factor, OptionalGradient<T> gradient) {
  T sum(0.0);
  for (const JointLoad& load : view.system.loads()) {
    if (load.pair != term.pair || load.element != term.element) continue;
    const auto before = mark(gradient);
    if (term.kind == SignalKind::kJointEffort || term.kind == SignalKind::kJointEffortRate) {
      const bool is_rate = term.kind == SignalKind::kJointEffortRate;
      sum += factor * (is_rate ? applied_effort_rate(view, load, gradient) : applied_effort(view, load, gradient));
      if (gradient) gradient->scale_from(before, factor);
      continue;
    }
    const CoordinateMotion<T>& motion =
        view.coordinate(term.pair, term.element, gradient ? CoordinateDetail::kGradient : CoordinateDetail::kRate);
    sum -= factor * joint_load(view, friction_part(load), motion, gradient);
    if (gradient) gradient->scale_from(before, T(-factor));
  }
  return sum;
}

/// Isotropic friction of a pair, minus its magnitude, or its speed of slip; theory (13a).
template <class T>
T contact_term(const StateView<T>& view, const SignalReference& term, const T& factor, OptionalGradient<T> gradient) {
  const ContactFriction<T> c = contact_at(view, term.pair);
  const bool friction = term.kind == SignalKind::kContactFriction;
  const T length = friction ? c.magnitude() : c.speed();
  if (gradient) {
    // At rest the length has no derivative; zero takes its place, as in length_of().
    const T scale = is_less(T(0.0), length, true) ? T((friction ? -factor : factor) / length) : T(0.0);
    for (std::size_t k = 0; k < c.reported; ++k) {
      const T load = c.load[static_cast<Eigen::Index>(k)];
      if (friction) append_contact_load(view, term.pair, c, k, T(scale * load), gradient);
      if (!friction) append_slip_rate(view, term.pair, c, k, T(scale * c.motion[k].rate), gradient);
    }
  }
  return friction ? T(-factor * length) : T(factor * length);
}

/// An energy [J] or a power [W] of the whole mechanism, or a power of one joint, theory (14b), (14c); without a factor.
template <class T>
T energy_or_power(const StateView<T>& view, const SignalReference& term, OptionalGradient<T> gradient) {
  const auto power_of = [&](PowerKind kind) {
    return term.pair < 0 ? total_power(view, kind, gradient) : joint_power(view, kind, term.pair, term.element, gradient);
  };
  switch (term.kind) {
    case SignalKind::kKineticEnergy:
      return kinetic_energy(view, gradient);
    case SignalKind::kPotentialEnergy:
      return potential_energy(view, gradient);
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
  // Two statements, because the order in which entries are appended must not depend on the compiler: an assembly is recorded once.
  const T kinetic = kinetic_energy(view, gradient);
  return kinetic + potential_energy(view, gradient);
}

/// Any term of a signal.
template <class T>
T term_value(const StateView<T>& view, const SignalReference& term, const T& factor, OptionalGradient<T> gradient) {
  const auto before = mark(gradient);
  switch (term.kind) {
    case SignalKind::kLinkPosition:
    case SignalKind::kLinkVelocity:
    case SignalKind::kLinkAcceleration:
    case SignalKind::kLinkAngularVelocity:
      return link_term(view, term, factor, gradient);
    case SignalKind::kControllerError:
    case SignalKind::kControllerOutput: {
      const bool is_error = term.kind == SignalKind::kControllerError;
      const T value = is_error ? controller_error(view, term.controller, gradient) : controller_output(view, term.controller, gradient);
      if (gradient) gradient->scale_from(before, factor);
      return factor * value;
    }
    case SignalKind::kControllerErrorRate:
      return controller_error_rate(view, term.controller, factor, gradient);
    case SignalKind::kControllerSetpoint:
      return controller_setpoint(view, term.controller, 0, factor, gradient);
    case SignalKind::kControllerSetpointRate:
      return controller_setpoint(view, term.controller, 1, factor, gradient);
    case SignalKind::kControllerIntegral: {
      const int s = view.system.controllers()[static_cast<std::size_t>(term.controller)].state;
      if (gradient) gradient->position.push_back({view.layout.position_column(s), factor});
      return factor * view.state->s[s];
    }
    case SignalKind::kContactFriction:
    case SignalKind::kContactSpeed:
      return contact_term(view, term, factor, gradient);
    case SignalKind::kLinkOrientation:
      return orientation_term(view, term, factor, gradient);
    case SignalKind::kReactionForce:
    case SignalKind::kReactionTorque:
      return reaction_term(view, term, factor, gradient);
    case SignalKind::kKineticEnergy:
    case SignalKind::kPotentialEnergy:
    case SignalKind::kTotalEnergy:
    case SignalKind::kFrictionPower:
    case SignalKind::kDampingPower:
    case SignalKind::kActuatorPower:
    case SignalKind::kLoadPower: {
      const T value = energy_or_power(view, term, gradient);
      if (gradient) gradient->scale_from(before, factor);
      return factor * value;
    }
    case SignalKind::kJointEffort:
    case SignalKind::kJointEffortRate:
    case SignalKind::kJointFriction:
      return load_term(view, term, factor, gradient);
    case SignalKind::kJointNormalForce: {
      const NormalForce<T> N = normal_force(view, term.pair);
      if (gradient) append_normal_gradient(view, term.pair, N.F, N.torque, factor, gradient);
      return factor * N.value;
    }
    default:
      return joint_term(view, term, factor, gradient);
  }
}

/// factor times a signal, the sum of its terms. Appends factor times its gradient.
template <class T>
T signal_value(const StateView<T>& view, const Signal& signal, const T& factor, OptionalGradient<T> gradient) {
  T sum(0.0);
  for (const SignalReference& term : signal) sum += term_value(view, term, T(T(term.factor) * factor), gradient);
  return sum;
}

}  // namespace codesign

#endif  // MECHANISM_CODESIGN_ELEMENTS_SIGNALS_H_
