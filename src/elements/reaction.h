// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_ELEMENTS_REACTION_H_
#define MECHANISM_CODESIGN_ELEMENTS_REACTION_H_

#include "elements/contact.h"
#include "elements/gradient_rows.h"
#include "elements/joint_load.h"
#include "elements/reaction_axis.h"
#include "elements/rotor.h"
#include "elements/state_view.h"
#include "joints/coordinate_load.h"
#include "joints/pair_motion.h"

namespace codesign {

// The wrench of a joint on its child, theory (11a): one component of the force [N] or of the torque [N m], in the axes of the joint frame
// that the child carries. Each function appends its gradient if `gradient` is not null.

/// The axis and the origin of the joint frame for one component of a reaction signal.
template <class T>
ReactionAxis<T> reaction_axis(const StateView<T>& view, const SignalReference& term) {
  const Pair& pair = view.system.topology().pairs[static_cast<std::size_t>(term.pair)];
  const ChainElement& element = pair.chain[static_cast<std::size_t>(term.element)];
  const LinkConstants<T>& frame = view.design.constants.joint_frames[static_cast<std::size_t>(element.joint)];
  ReactionAxis<T> axis;
  axis.pair = term.pair;
  axis.side = element.reversed ? Side::kI : Side::kJ;
  axis.body = element.reversed ? pair.body_i : pair.body_j;
  axis.torque = term.kind == SignalKind::kReactionTorque;
  axis.e = frame.R.col(term.axis);
  axis.s = frame.s;
  return axis;
}

/// The contribution of one product row: the sum of -c lambda (+- A d) . Y over the terms of X on the child, and likewise for the terms of
/// Y.
/// @param row the row's multiplier in z.
template <class T>
T product_reaction(const StateView<T>& view, const ReactionAxis<T>& axis, const ProductRow<T>& product, int row,
                   OptionalGradient<T> gradient) {
  const Pair& pair = view.system.topology().pairs[static_cast<std::size_t>(axis.pair)];
  const BodyKinematics<T>&i = view.body(pair.body_i), &j = view.body(pair.body_j);
  T value(0.0);
  const auto add = [&](const PairVector<T>& own, const PairVector<T>& partner) {
    for (int k = 0; k < own.terms; ++k) {
      const VectorTerm<T>& term = own.term[k];
      if (term.side != axis.side || (!axis.torque && !term.point)) continue;
      const PairVector<T> D = PairVector<T>::direction(axis.side, axis.lever(term.s, term.point));
      const VectorMotion<T> x = motion_of(D, i, j), y = motion_of(partner, i, j);
      const T weight(-term.sign * product.scale), component = weight * dot<T>(x.x, y.x);
      value += component * view.state->z[row];
      if (!gradient) continue;
      gradient->rate.push_back({row, component});
      append_local(view, axis.pair, product_gradient(D, partner, x, y, i, j, 0).phi_q, T(weight * view.state->z[row]), partner.terms == 2,
                   &gradient->position);
    }
  };
  add(product.X, product.Y);
  add(product.Y, product.X);
  return value;
}

/// The contribution of all constraint rows of the pair.
template <class T>
T constraint_reaction(const StateView<T>& view, const ReactionAxis<T>& axis, OptionalGradient<T> gradient) {
  const PairRows<T>& rows = view.design.rows[static_cast<std::size_t>(axis.pair)];
  int row = view.layout.lambda_column(view.layout.pair_row[static_cast<std::size_t>(axis.pair)]);
  T value(0.0);
  if (rows.coincident) {
    // The multipliers are the force at the joint's point: -lambda acts on body j, +lambda on body i. Either may be the child.
    const BodyKinematics<T>& k = view.body(axis.body);
    const T sign(axis.side == Side::kJ ? -1.0 : 1.0);
    const Vector3<T> lambda = view.state->z.template segment<3>(row), lever = sign * axis.lever(rows.point(axis.side), true),
                     direction = k.A * lever;
    value += dot<T>(direction, lambda);
    for (int l = 0; gradient && l < 3; ++l) gradient->rate.push_back({row + l, direction[l]});
    if (gradient && axis.body >= 0) {
      const Vector4<T> by_p = rotated_vector_jacobian(k.p, lever).transpose() * lambda;
      for (int e = 0; e < 4; ++e) gradient->position.push_back({kBodySize * axis.body + 3 + e, by_p[e]});
    }
    row += 3;
  }
  for (const ProductRow<T>& product : rows.products) value += product_reaction(view, axis, product, row++, gradient);
  return value;
}

/// The contribution of one load L along a coordinate of the joint: -L times (11a) of its J^T.
/// @param own the mark before the gradient of L was appended; that gradient is multiplied here, and the derivative of J^T is appended.
template <class T>
T load_reaction(const StateView<T>& view, const ReactionAxis<T>& axis, const CoordinateConstants<T>& coordinate, const LocalRow<T>& J,
                const T& load, const typename SparseGradient<T>::Mark& own, OptionalGradient<T> gradient) {
  const BodyKinematics<T>& k = view.body(axis.body);
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
  const Pair& pair = view.system.topology().pairs[static_cast<std::size_t>(axis.pair)];
  coordinate_load_gradient(view.design.constants.pairs[static_cast<std::size_t>(axis.pair)], coordinate, view.body(pair.body_i),
                           view.body(pair.body_j), load, [&](int row, int local, const T& entry) {
                             const int c = view.column(axis.pair, local);
                             if (c < 0 || row < r || row >= r + kBodySize) return;
                             gradient->position.push_back({c, T((row < p ? along_r[row - r] : along_p[row - p]) * entry)});
                           });
  const Vector4<T> by_p = load * (rotated_vector_jacobian(k.p, lever).transpose() * J_r + body_rate_hessian(turn).transpose() * J_p);
  for (int e = 0; e < 4; ++e) gradient->position.push_back({kBodySize * axis.body + 3 + e, by_p[e]});
  return share * load;
}

/// The contribution of friction, damping, springs, stops, controllers and constant efforts along the joint's coordinates.
template <class T>
T coordinate_reaction(const StateView<T>& view, const ReactionAxis<T>& axis, OptionalGradient<T> gradient) {
  T value(0.0);
  for (const JointLoad& load : view.system.loads()) {
    if (load.pair != axis.pair) continue;
    // A copy, since a controller may request more detail of this coordinate, which overwrites the referenced object.
    const CoordinateMotion<T> motion =
        view.coordinate(load.pair, load.element, load.needs_position() ? CoordinateDetail::kAll : CoordinateDetail::kGradient);
    const auto own = mark(gradient);
    const T load_value = joint_load(view, load, motion, gradient);
    value += load_reaction(view, axis, view.coordinate_constants(load.pair, load.element), motion.J, load_value, own, gradient);
  }
  return value;
}

/// The contribution of the rotors that the joint drives, theory (9a).
template <class T>
T rotor_reaction(const StateView<T>& view, const ReactionAxis<T>& axis, OptionalGradient<T> gradient) {
  T value(0.0);
  for (const Rotor& rotor : view.system.rotors()) {
    if (rotor.pair != axis.pair) continue;
    const auto own = mark(gradient);
    const T load = rotor_load(view, rotor, gradient);
    const LocalRow<T>& J = view.coordinate(rotor.pair, rotor.element, CoordinateDetail::kGradient).J;
    value += load_reaction(view, axis, view.coordinate_constants(rotor.pair, rotor.element), J, load, own, gradient);
  }
  return value;
}

/// The contribution of the couplings of the joint's coordinates, theory (8a).
template <class T>
T coupling_reaction(const StateView<T>& view, const ReactionAxis<T>& axis, OptionalGradient<T> gradient) {
  T value(0.0);
  for (std::size_t k = 0; k < view.design.constants.couplings.size(); ++k) {
    const Coupling& coupling = view.system.topology().couplings[k];
    const int row = view.layout.lambda_column(view.layout.coupling_row(static_cast<int>(k)));
    for (std::size_t t = 0; t < coupling.terms.size(); ++t) {
      const CouplingTerm& term = coupling.terms[t];
      if (term.pair != axis.pair) continue;
      const auto own = mark(gradient);
      const T& coefficient = view.design.constants.couplings[k].coefficients[t];
      if (gradient) gradient->rate.push_back({row, coefficient});
      value += load_reaction(view, axis, view.coordinate_constants(term.pair, term.element), view.coordinate(term.pair, term.element).J,
                             T(coefficient * view.state->z[row]), own, gradient);
    }
  }
  return value;
}

/// The contribution of isotropic friction, theory (13a), for a pair among System::contacts().
template <class T>
T contact_reaction(const StateView<T>& view, const ReactionAxis<T>& axis, OptionalGradient<T> gradient) {
  const ContactFriction<T> c = contact_at(view, axis.pair);
  T value(0.0);
  for (std::size_t k = 0; k < c.size; ++k) {
    const auto own = mark(gradient);
    if (gradient) append_contact_load(view, axis.pair, c, k, T(1.0), gradient);
    value += load_reaction(view, axis, view.design.constants.pairs[static_cast<std::size_t>(axis.pair)].slip.coordinates[k], c.motion[k].J,
                           c.load[static_cast<Eigen::Index>(k)], own, gradient);
  }
  return value;
}

/// The part of a reaction signal that comes from multipliers: constraint rows and couplings. Redundant rows leave this part undetermined.
template <class T>
T multiplier_reaction(const StateView<T>& view, const SignalReference& term) {
  const ReactionAxis<T> axis = reaction_axis(view, term);
  const T value = constraint_reaction(view, axis, nullptr);
  return value + coupling_reaction(view, axis, nullptr);
}

/// factor times one component of the whole wrench of a joint on its child.
template <class T>
T reaction_term(const StateView<T>& view, const SignalReference& term, const T& factor, OptionalGradient<T> gradient) {
  const ReactionAxis<T> axis = reaction_axis(view, term);
  const auto before = mark(gradient);
  // One statement each: the order in which entries are appended must not depend on the compiler, since an assembly is recorded once.
  T value = constraint_reaction(view, axis, gradient);
  value += coordinate_reaction(view, axis, gradient);
  value += coupling_reaction(view, axis, gradient);
  for (int pair : view.system.contacts())
    if (pair == axis.pair) value += contact_reaction(view, axis, gradient);
  value += rotor_reaction(view, axis, gradient);
  if (gradient) gradient->scale_from(before, factor);
  return factor * value;
}

}  // namespace codesign

#endif  // MECHANISM_CODESIGN_ELEMENTS_REACTION_H_
