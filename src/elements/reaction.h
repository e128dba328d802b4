// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "elements/body.h"
#include "elements/contact.h"
#include "elements/joint_load.h"
#include "elements/link_axes.h"
#include "elements/state_view.h"
#include "joints/pair_rows.h"
#include "math/arrays.h"

namespace codesign {

// The wrench of a joint on its child, theory (11a): one component of the force [N] or of the torque
// [N m], in the axes of the joint frame that the child carries, or of a link that the term names.

/// One component of the wrench of a joint on its child: the force along, or the torque about, an
/// axis of the joint frame that the child carries, or an axis of another link; theory (11a).
template <class T>
struct ReactionAxis {
  int pair = -1;
  Side side = Side::kJ;  ///< side of the pair that the child is on
  int body = -1;         ///< the child; -1 if it is the ground
  bool torque = false;   ///< torque about the axis through s, else force along the axis
  Vector3<T> e, s;       ///< the axis, and the origin of the joint frame, in body coordinates

  /// The vector d of (11a) in body axes: a load b on the child's vector A s_t contributes (A d) . b
  /// to the component. d is e for a force, e x (s_t - s) for a torque and a point, e x s_t for a
  /// torque and a direction. @param point whether A s_t is a point or a direction.
  Vector3<T> lever(const Vector3<T>& s_t, bool point) const {
    if (!torque) return e;
    return cross<T>(e, point ? Vector3<T>(s_t - s) : s_t);
  }
};

/// The axis and the origin of the joint frame for one component of a reaction signal.
template <class T>
ReactionAxis<T> reaction_axis(const StateView<T>& view, const SignalReference& term) {
  const Pair& pair = view.pair(term.pair);
  const ChainElement& element = pair.chain[to_index(term.element)];
  const LinkConstants<T>& frame = view.design.constants.joint_frames[to_index(element.joint)];
  ReactionAxis<T> axis;
  axis.pair = term.pair;
  axis.side = element.reversed ? Side::kI : Side::kJ;
  axis.body = element.reversed ? pair.body_i : pair.body_j;
  axis.torque = term.kind == SignalKind::kReactionTorque;
  axis.e = term.axes < 0 ? Vector3<T>(frame.R.col(term.axis))
                         : Vector3<T>(view.body(axis.body).A.transpose() *
                                      axis_of_link(view, term.axes, term.axis));
  axis.s = frame.s;
  return axis;
}

/// The contribution of one product row: the sum of -c lambda (+- A d) . Y over the terms of X on
/// the child, and likewise for the terms of Y.
/// @param lambda the row's multiplier.
template <class T>
T product_reaction(const StateView<T>& view, const ReactionAxis<T>& axis,
                   const ProductRow<T>& product, const T& lambda) {
  const Pair& pair = view.pair(axis.pair);
  const BodyKinematics<T>&i = view.body(pair.body_i), &j = view.body(pair.body_j),
        &child = view.body(axis.body);
  T value(0.0);
  const auto add = [&](const PairVector<T>& own, const PairVector<T>& partner) {
    for (int k = 0; k < own.terms; ++k) {
      const VectorTerm<T>& term = own.term[k];
      if (term.side != axis.side || (!axis.torque && !term.point)) continue;
      const Vector3<T> direction = child.A * axis.lever(term.s, term.point);
      value +=
          T(-term.sign * product.scale) * dot<T>(direction, motion_of(partner, i, j).x) * lambda;
    }
  };
  add(product.X, product.Y);
  add(product.Y, product.X);
  return value;
}

/// The contribution of all constraint rows of the pair.
template <class T>
T constraint_reaction(const StateView<T>& view, const ReactionAxis<T>& axis) {
  const PairRows<T>& rows = view.design.rows[to_index(axis.pair)];
  int row = view.layout.lambda_column(view.layout.pair_row[to_index(axis.pair)]);
  T value(0.0);
  if (rows.coincident) {
    // The multipliers are the force at the joint's point: -lambda acts on body j, +lambda on body
    // i. Either may be the child.
    const T sign(axis.side == Side::kJ ? -1.0 : 1.0);
    const Vector3<T> lambda = view.state->z.template segment<3>(row),
                     lever = sign * axis.lever(rows.point(axis.side), true);
    value += dot<T>(view.body(axis.body).A * lever, lambda);
    row += 3;
  }
  for (const ProductRow<T>& product : rows.products)
    value += product_reaction(view, axis, product, T(view.state->z[row++]));
  return value;
}

/// The component of a wrench on the child, about its centre of mass and in its axes.
template <class T>
T wrench_component(const ReactionAxis<T>& axis, const Wrench<T>& wrench) {
  if (!axis.torque) return dot<T>(axis.e, wrench.force);
  return dot<T>(axis.e, wrench.moment) - dot<T>(cross<T>(axis.e, axis.s), wrench.force);
}

/// The contribution of one load L along a coordinate of the joint: -L times (11a) of its J^T.
template <class T>
T load_reaction(const StateView<T>& view, const ReactionAxis<T>& axis, const LocalRow<T>& J,
                const T& load) {
  const BodyKinematics<T>& k = view.body(axis.body);
  if (k.in_forest) return -wrench_component(axis, load_on_side(k, axis.side, J, load));
  const Vector3<T> lever = -axis.lever(Vector3<T>(Vector3<T>::Zero()), true), along_r = k.A * lever,
                   turn =
                       axis.torque ? Vector3<T>(T(-0.5) * axis.e) : Vector3<T>(Vector3<T>::Zero());
  const Vector4<T> along_p = body_rate_transposed(k.p, turn);
  const Vector3<T> J_r = J.template segment<3>(r_offset(axis.side));
  const Vector4<T> J_p = J.template segment<4>(p_offset(axis.side));
  T share = dot<T>(along_r, J_r);
  for (int e = 0; e < 4; ++e) share += along_p[e] * J_p[e];
  return share * load;
}

/// The contribution of friction, damping, springs, stops, controllers and constant efforts along
/// the joint's coordinates.
template <class T>
T coordinate_reaction(const StateView<T>& view, const ReactionAxis<T>& axis) {
  T value(0.0);
  for (const JointLoad& load : view.system.loads()) {
    if (load.pair != axis.pair) continue;
    // A copy, since a controller may request more detail of this coordinate, which overwrites the
    // referenced object.
    const CoordinateMotion<T> motion =
        view.coordinate(load.pair, load.element, CoordinateDetail::kRate);
    value += load_reaction(view, axis, motion.J, joint_load(view, load, motion.rate));
  }
  return value;
}

/// The contribution of the rotors that the joint drives, theory (9a).
template <class T>
T rotor_reaction(const StateView<T>& view, const ReactionAxis<T>& axis) {
  T value(0.0);
  for (const Rotor& rotor : view.system.rotors())
    if (rotor.pair == axis.pair)
      value += load_reaction(
          view, axis, view.coordinate(rotor.pair, rotor.element, CoordinateDetail::kAcceleration).J,
          rotor_load(view, rotor));
  return value;
}

/// The contribution of the couplings of the joint's coordinates, theory (8a).
template <class T>
T coupling_reaction(const StateView<T>& view, const ReactionAxis<T>& axis) {
  T value(0.0);
  for (std::size_t k = 0; k < view.design.constants.couplings.size(); ++k) {
    const Coupling& coupling = view.system.topology().couplings[k];
    const int row = view.layout.lambda_column(view.layout.coupling_row(static_cast<int>(k)));
    for (std::size_t t = 0; t < coupling.terms.size(); ++t) {
      const CouplingTerm& term = coupling.terms[t];
      if (term.pair != axis.pair) continue;
      value += load_reaction(
          view, axis, view.coordinate(term.pair, term.element, CoordinateDetail::kRate).J,
          T(view.design.constants.couplings[k].coefficients[t] * view.state->z[row]));
    }
  }
  return value;
}

/// The contribution of isotropic friction, theory (13a), for a pair among System::contacts().
template <class T>
T contact_reaction(const StateView<T>& view, const ReactionAxis<T>& axis) {
  const ContactFriction<T> c = contact_at(view, axis.pair);
  T value(0.0);
  for (std::size_t k = 0; k < c.size; ++k)
    value += load_reaction(view, axis, c.motion[k].J, T(c.load[to_signed(k)]));
  return value;
}

/// The part of a reaction signal that comes from multipliers: constraint rows and couplings.
/// Redundant rows leave this part undetermined.
template <class T>
T multiplier_reaction(const StateView<T>& view, const SignalReference& term) {
  if (!view.layout.is_cut(term.pair)) return T(0.0);
  const ReactionAxis<T> axis = reaction_axis(view, term);
  return constraint_reaction(view, axis) + coupling_reaction(view, axis);
}

/// One component of the whole wrench of a joint on its child.
template <class T>
T reaction_term(const StateView<T>& view, const SignalReference& term) {
  const ReactionAxis<T> axis = reaction_axis(view, term);
  // The wrench that a joint of the forest transmits is the whole one, (57).
  if (!view.layout.is_cut(term.pair))
    return wrench_component(axis, transmitted_wrench(view, axis.body));
  T value = constraint_reaction(view, axis) + coordinate_reaction(view, axis) +
            coupling_reaction(view, axis);
  for (int pair : view.system.contacts())
    if (pair == axis.pair) value += contact_reaction(view, axis);
  return value + rotor_reaction(view, axis);
}

}  // namespace codesign
