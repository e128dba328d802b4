// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_EQUATIONS_EQUATIONS_REACTIONS_H_
#define MECHANISM_CODESIGN_EQUATIONS_EQUATIONS_REACTIONS_H_

#include "equations/equations.h"

namespace codesign {

// What a joint exerts on its child, theory (11a): one component of the force or of the torque in the joint frame that the child carries.

template <class T>
ReactionAxis<T> Equations<T>::reaction_axis(const SignalReference& term) const {
  const Pair& pair = system_.topology().pairs[static_cast<std::size_t>(term.pair)];
  const ChainElement& element = pair.chain[static_cast<std::size_t>(term.element)];
  const LinkConstants<T>& frame = constants_.joint_frames[static_cast<std::size_t>(element.joint)];
  ReactionAxis<T> axis;
  axis.pair = term.pair;
  axis.side = element.reversed ? Side::kI : Side::kJ;
  axis.body = element.reversed ? pair.body_i : pair.body_j;
  axis.torque = term.kind == SignalKind::kReactionTorque;
  axis.e = frame.R.col(term.axis);
  axis.s = frame.s;
  return axis;
}

template <class T>
T Equations<T>::reaction_term(const SignalReference& term, const T& factor, SparseGradient<T>* gradient) {
  const ReactionAxis<T> axis = reaction_axis(term);
  const auto before = mark(gradient);
  // In this order for every scalar, as the gradient's entries are found again by it.
  T value = constraint_reaction(axis, gradient);
  value += coordinate_reaction(axis, gradient);
  value += coupling_reaction(axis, gradient);
  for (int pair : system_.contacts())
    if (pair == axis.pair) value += contact_reaction(axis, gradient);
  value += rotor_reaction(axis, gradient);
  if (gradient) gradient->scale_from(before, factor);
  return factor * value;
}

template <class T>
T Equations<T>::multiplier_reaction(const SignalReference& term) {
  const ReactionAxis<T> axis = reaction_axis(term);
  const T value = constraint_reaction(axis, nullptr);
  return value + coupling_reaction(axis, nullptr);
}

// Friction, damping, springs, stops, controllers and constant loads along the joint's coordinates.
template <class T>
T Equations<T>::coordinate_reaction(const ReactionAxis<T>& axis, SparseGradient<T>* gradient) {
  T value(0.0);
  for (const JointLoad& load : system_.loads()) {
    if (load.pair != axis.pair) continue;
    // A copy: controllers may ask for other coordinates, and for this one in more detail.
    const CoordinateMotion<T> motion =
        coordinate(load.pair, load.element, load.needs_position() ? CoordinateDetail::kAll : CoordinateDetail::kGradient);
    const auto own = mark(gradient);
    const T load_value = joint_load(load, motion, gradient);
    value += load_reaction(axis, coordinate_constants(load.pair, load.element), motion.J, load_value, own, gradient);
  }
  return value;
}

template <class T>
T Equations<T>::rotor_reaction(const ReactionAxis<T>& axis, SparseGradient<T>* gradient) const {
  T value(0.0);
  for (const Rotor& rotor : system_.rotors()) {
    if (rotor.pair != axis.pair) continue;
    const auto own = mark(gradient);
    const T load = rotor_load(rotor, gradient);
    const LocalRow<T>& J = coordinate(rotor.pair, rotor.element, CoordinateDetail::kGradient).J;
    value += load_reaction(axis, coordinate_constants(rotor.pair, rotor.element), J, load, own, gradient);
  }
  return value;
}

template <class T>
T Equations<T>::constraint_reaction(const ReactionAxis<T>& axis, SparseGradient<T>* gradient) const {
  const PairRows<T>& rows = rows_[static_cast<std::size_t>(axis.pair)];
  int row = layout_.lambda_column(layout_.pair_row[static_cast<std::size_t>(axis.pair)]);
  T value(0.0);
  if (rows.coincident) {
    // Pushed with -lambda at its point, the child; with +lambda where it is body i.
    const BodyKinematics<T>& k = body(axis.body);
    const T sign(axis.side == Side::kJ ? -1.0 : 1.0);
    const Vector3<T> lambda = state_->z.template segment<3>(row), lever = sign * axis.lever(rows.point(axis.side), true),
                     direction = k.A * lever;
    value += dot<T>(direction, lambda);
    for (int l = 0; gradient && l < 3; ++l) gradient->rate.push_back({row + l, direction[l]});
    if (gradient && axis.body >= 0) {
      const Vector4<T> by_p = rotated_vector_jacobian(k.p, lever).transpose() * lambda;
      for (int e = 0; e < 4; ++e) gradient->position.push_back({kBodySize * axis.body + 3 + e, by_p[e]});
    }
    row += 3;
  }
  for (const ProductRow<T>& product : rows.products) value += product_reaction(axis, product, row++, gradient);
  return value;
}

// Every term of X that the child carries is pushed along Y, and the other way round.
template <class T>
T Equations<T>::product_reaction(const ReactionAxis<T>& axis, const ProductRow<T>& product, int row, SparseGradient<T>* gradient) const {
  const Pair& pair = system_.topology().pairs[static_cast<std::size_t>(axis.pair)];
  const BodyKinematics<T>&i = body(pair.body_i), &j = body(pair.body_j);
  T value(0.0);
  const auto add = [&](const PairVector<T>& own, const PairVector<T>& partner) {
    for (int k = 0; k < own.terms; ++k) {
      const VectorTerm<T>& term = own.term[k];
      if (term.side != axis.side || (!axis.torque && !term.point)) continue;
      const PairVector<T> D = PairVector<T>::direction(axis.side, axis.lever(term.s, term.point));
      const VectorMotion<T> x = motion_of(D, i, j), y = motion_of(partner, i, j);
      const T weight(-term.sign * product.scale), component = weight * dot<T>(x.x, y.x);
      value += component * state_->z[row];
      if (!gradient) continue;
      gradient->rate.push_back({row, component});
      append_local(axis.pair, product_gradient(D, partner, x, y, i, j, 0).phi_q, T(weight * state_->z[row]), partner.terms == 2,
                   &gradient->position);
    }
  };
  add(product.X, product.Y);
  add(product.Y, product.X);
  return value;
}

template <class T>
T Equations<T>::load_reaction(const ReactionAxis<T>& axis, const CoordinateConstants<T>& coordinate, const LocalRow<T>& J, const T& load,
                              const typename SparseGradient<T>::Mark& own, SparseGradient<T>* gradient) const {
  const BodyKinematics<T>& k = body(axis.body);
  const int r = r_offset(axis.side), p = p_offset(axis.side);
  const Vector3<T> lever = -axis.lever(Vector3<T>(Vector3<T>::Zero()), true), along_r = k.A * lever,
                   turn = axis.torque ? Vector3<T>(T(-0.5) * axis.e) : Vector3<T>(Vector3<T>::Zero());
  const Vector4<T> along_p = body_rate_transposed(k.p, turn);
  const Vector3<T> J_r = J.template segment<3>(r);
  const Vector4<T> J_p = J.template segment<4>(p);
  T share = dot<T>(along_r, J_r);
  for (int e = 0; e < 4; ++e) share += along_p[e] * J_p[e];
  if (!gradient) return share * load;
  gradient->scale_from(own, share);
  if (axis.body < 0) return share * load;
  const Pair& pair = system_.topology().pairs[static_cast<std::size_t>(axis.pair)];
  coordinate_load_gradient(constants_.pairs[static_cast<std::size_t>(axis.pair)], coordinate, body(pair.body_i), body(pair.body_j), load,
                           [&](int row, int local, const T& entry) {
                             const int c = column(axis.pair, local);
                             if (c < 0 || row < r || row >= r + kBodySize) return;
                             gradient->position.push_back({c, T((row < p ? along_r[row - r] : along_p[row - p]) * entry)});
                           });
  const Vector4<T> by_p = load * (rotated_vector_jacobian(k.p, lever).transpose() * J_r + body_rate_hessian(turn).transpose() * J_p);
  for (int e = 0; e < 4; ++e) gradient->position.push_back({kBodySize * axis.body + 3 + e, by_p[e]});
  return share * load;
}

template <class T>
T Equations<T>::coupling_reaction(const ReactionAxis<T>& axis, SparseGradient<T>* gradient) const {
  T value(0.0);
  for (std::size_t k = 0; k < constants_.couplings.size(); ++k) {
    const Coupling& coupling = system_.topology().couplings[k];
    const int row = layout_.lambda_column(layout_.coupling_row(static_cast<int>(k)));
    for (std::size_t t = 0; t < coupling.terms.size(); ++t) {
      const CouplingTerm& term = coupling.terms[t];
      if (term.pair != axis.pair) continue;
      const auto own = mark(gradient);
      const T& coefficient = constants_.couplings[k].coefficients[t];
      if (gradient) gradient->rate.push_back({row, coefficient});
      value += load_reaction(axis, coordinate_constants(term.pair, term.element), coordinate(term.pair, term.element).J,
                             T(coefficient * state_->z[row]), own, gradient);
    }
  }
  return value;
}

template <class T>
T Equations<T>::contact_reaction(const ReactionAxis<T>& axis, SparseGradient<T>* gradient) const {
  const ContactFriction<T> c = contact(axis.pair);
  T value(0.0);
  for (std::size_t k = 0; k < c.size; ++k) {
    const auto own = mark(gradient);
    if (gradient) append_contact_load(axis.pair, c, k, T(1.0), gradient);
    value += load_reaction(axis, constants_.pairs[static_cast<std::size_t>(axis.pair)].slip.coordinates[k], c.motion[k].J,
                           c.load[static_cast<Eigen::Index>(k)], own, gradient);
  }
  return value;
}

}  // namespace codesign

#endif  // MECHANISM_CODESIGN_EQUATIONS_EQUATIONS_REACTIONS_H_
