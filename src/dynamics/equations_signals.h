// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_SRC_DYNAMICS_EQUATIONS_SIGNALS_H_
#define MECHANISM_CODESIGN_SRC_DYNAMICS_EQUATIONS_SIGNALS_H_

#include "mechanism_codesign/dynamics/equations.h"

namespace codesign {

template <class T>
T Equations<T>::joint_term(const SignalReference& term, const T& factor, SparseGradient<T>* gradient) {
  const bool rate_only = !gradient && (term.kind == SignalKind::kJointVelocity || term.kind == SignalKind::kJointSlidingVelocity);
  const CoordinateMotion<T> m = coordinate(term.pair, term.element, rate_only ? CoordinateDetail::kRate : CoordinateDetail::kAll);
  const bool with_r = coordinate_moves_r(term.pair, term.element);
  const auto append = [&](const LocalRow<T>* position, const LocalRow<T>* velocity, const LocalRow<T>* rate) {
    if (gradient) append_local(term.pair, position, velocity, rate, factor, with_r, gradient);
  };
  switch (term.kind) {
    case SignalKind::kJointPosition: append(&m.position_q, nullptr, nullptr); return factor * m.position;
    case SignalKind::kJointAcceleration: append(&m.acceleration_q, &m.acceleration_v, &m.J); return factor * m.acceleration;
    default: append(&m.rate_q, &m.J, nullptr); return factor * m.rate;
  }
}

template <class T>
T Equations<T>::link_term(const SignalReference& term, const T& factor, SparseGradient<T>* gradient) {
  const int index = system_.topology().link_body[static_cast<std::size_t>(term.link)], c = kBodySize * index;
  const BodyKinematics<T>& k = body(index);
  const Vector3<T>& s = constants_.links[static_cast<std::size_t>(term.link)].s;
  const T zero(0.0);
  const bool turning = term.kind == SignalKind::kLinkAngularVelocity;
  const int order = term.kind == SignalKind::kLinkPosition ? 0 : term.kind == SignalKind::kLinkVelocity ? 1 : 2;
  if (gradient && index >= 0) {
    const T one[3] = {order == 0 ? factor : zero, order == 1 ? factor : zero, order == 2 ? factor : zero};
    if (!turning) gradient->push_back({c + term.axis, one[0], one[1], one[2]});
    const Matrix34<T> B0 = turning ? Matrix34<T>(T(-2.0) * ground_rate_matrix(k.pd)) : rotated_vector_jacobian(k.p, s);
    const Matrix34<T> B1 = turning ? Matrix34<T>(T(2.0) * ground_rate_matrix(k.p)) : rotated_vector_jacobian(k.pd, s);
    const Matrix34<T> B2 = rotated_vector_jacobian(k.pdd, s);
    for (int e = 0; e < 4; ++e) {
      const T b0 = factor * B0(term.axis, e), b1 = factor * B1(term.axis, e), b2 = factor * B2(term.axis, e);
      if (turning) gradient->push_back({c + 3 + e, b0, b1, zero});
      if (!turning && order == 0) gradient->push_back({c + 3 + e, b0, zero, zero});
      if (!turning && order == 1) gradient->push_back({c + 3 + e, b1, b0, zero});
      if (!turning && order == 2) gradient->push_back({c + 3 + e, b2, T(T(2.0) * b1), b0});
    }
  }
  if (turning) return factor * T(2.0) * (ground_rate_matrix(k.p) * k.pd)[term.axis];
  const Vector3<T> x = order == 0 ? k.r + k.A * s : order == 1 ? k.rd + k.Ad * s : k.rdd + k.Add * s;
  return factor * x[term.axis];
}

template <class T>
T Equations<T>::controller_error(int controller, SparseGradient<T>* gradient) {
  const auto c = static_cast<std::size_t>(controller);
  return setpoints_[c] + signal_value(system_.controllers()[c].input, T(-1.0), gradient);
}

template <class T>
T Equations<T>::controller_output(int controller, SparseGradient<T>* gradient) {
  const auto c = static_cast<std::size_t>(controller);
  const Controller& pid = system_.controllers()[c];
  T output = gains_p_[c] * setpoints_[c] + signal_value(pid.input, T(-gains_p_[c]), gradient);
  if (pid.state >= 0) {
    output += gains_i_[c] * state_->s[pid.state];
    if (gradient) gradient->push_back({layout_.state_column(pid.state), gains_i_[c], T(0.0), T(0.0)});
  }
  if (!pid.input_rate.empty()) output += signal_value(pid.input_rate, T(-gains_d_[c]), gradient);
  return output;
}

template <class T>
T Equations<T>::term_value(const SignalReference& term, const T& factor, SparseGradient<T>* gradient) {
  const std::size_t before = gradient ? gradient->size() : 0;
  switch (term.kind) {
    case SignalKind::kLinkPosition:
    case SignalKind::kLinkVelocity:
    case SignalKind::kLinkAcceleration:
    case SignalKind::kLinkAngularVelocity: return link_term(term, factor, gradient);
    case SignalKind::kControllerError: {
      const T value = controller_error(term.controller, gradient);
      if (gradient) scale_from(before, factor, gradient);
      return factor * value;
    }
    case SignalKind::kControllerErrorRate: return signal_value(system_.controllers()[static_cast<std::size_t>(term.controller)].input_rate, T(-factor), gradient);
    case SignalKind::kControllerOutput: {
      const T value = controller_output(term.controller, gradient);
      if (gradient) scale_from(before, factor, gradient);
      return factor * value;
    }
    case SignalKind::kControllerIntegral: {
      const int s = system_.controllers()[static_cast<std::size_t>(term.controller)].state;
      if (gradient) gradient->push_back({layout_.state_column(s), factor, T(0.0), T(0.0)});
      return factor * state_->s[s];
    }
    case SignalKind::kJointEffort:
    case SignalKind::kJointFriction: return load_term(term, factor, gradient);
    case SignalKind::kJointNormalForce: {
      const NormalForce<T> N = normal_force(term.pair);
      if (gradient) append_normal_gradient(term.pair, N.F, N.torque, factor, gradient);
      return factor * N.value;
    }
    default: return joint_term(term, factor, gradient);
  }
}

template <class T>
T Equations<T>::load_term(const SignalReference& term, const T& factor, SparseGradient<T>* gradient) {
  T sum(0.0);
  for (const JointLoad& load : system_.loads()) {
    if (load.pair != term.pair || load.element != term.element) continue;
    JointLoad part = load;
    part.passive = false;
    if (term.kind == SignalKind::kJointEffort) {
      part.reaction_friction = part.constant_friction = false;
    } else {
      part.controllers.clear();
    }
    const CoordinateMotion<T> motion = coordinate(term.pair, term.element);
    const std::size_t before = gradient ? gradient->size() : 0;
    sum -= factor * joint_load(part, motion, gradient);
    if (gradient) scale_from(before, T(-factor), gradient);
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
T Equations<T>::objective_terms(const std::vector<ResolvedTerm>& terms, const std::vector<T>& weights, const std::vector<T>& references,
                                SparseGradient<T>* gradient) {
  T sum(0.0);
  for (std::size_t k = 0; k < terms.size(); ++k) {
    const std::size_t before = gradient ? gradient->size() : 0;
    const T error = signal_value(terms[k].signal, T(1.0), gradient) - references[k];
    sum += weights[k] * error * error;
    if (gradient) scale_from(before, T(T(2.0) * weights[k] * error), gradient);
  }
  return sum;
}

template <class T>
T Equations<T>::terminal(const State<T>& state, SparseGradient<T>* gradient) {
  load(state);
  return objective_terms(system_.terminal(), terminal_weights_, terminal_references_, gradient);
}

}  // namespace codesign

#endif  // MECHANISM_CODESIGN_SRC_DYNAMICS_EQUATIONS_SIGNALS_H_
