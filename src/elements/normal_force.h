// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "elements/state_view.h"
#include "forces/normal_force.h"

namespace codesign {

// The normal force N in the bearing of a joint, computed from its reaction; theory (11), (12).

// Defined in elements/forest.h. Declared here because loads on bodies, of which it consists, may read normal forces of cut pairs.
/// The wrench that its joint transmits to a body of the forest, about the body's centre of mass, in its axes; theory (57).
template <class T>
const Wrench<T>& transmitted_wrench(const StateView<T>& view, int body);

/// pair_reaction() of a pair of the forest: the part that the pair constrains of the wrench that it transmits, about the point of body j.
template <class T>
void forest_reaction(const StateView<T>& view, int index, Vector3<T>* F, Vector3<T>* torque) {
  const auto p = static_cast<std::size_t>(index);
  const PairTraits& traits = traits_of(view.system.topology().pairs[p].kind);
  const PairConstants<T>& pair = view.design.constants.pairs[p];
  const int body = view.layout.forest.body_below[p];
  const Wrench<T>& wrench = transmitted_wrench(view, body);
  const Matrix3<T>& R = view.motion.poses[static_cast<std::size_t>(body)].R;
  const auto in_joint_axes = [&](const Vector3<T>& x) { return Vector3<T>(-(pair.C_i.transpose() * Vector3<T>(R * x))); };
  const Vector3<T> force = in_joint_axes(wrench.force);
  F->setZero();
  torque->setZero();
  if (traits.force == ForceRows::kAll) *F = force;
  if (traits.force == ForceRows::kAcross) *F = Vector3<T>(force[0], force[1], T(0.0));
  if (traits.force == ForceRows::kAlong) (*F)[2] = force[2];
  if (!traits.torque_rows) return;
  const int forces = traits.force == ForceRows::kAll      ? 3
                     : traits.force == ForceRows::kAcross ? 2
                     : traits.force == ForceRows::kAlong  ? 1
                                                          : 0;
  const Vector3<T> moment = in_joint_axes(Vector3<T>(wrench.moment - cross<T>(pair.s_j, wrench.force)));
  for (int k = 0; k < 2; ++k) (*torque)[k] = moment[k];
  if (traits.rows - forces > 2) (*torque)[2] = moment[2];
}

/// Reaction force F'' [N] and torque T'' [N m] in the joint axes of body i, read from the multipliers, theory (11); the child feels -F''
/// and -T''. Components that the pair does not constrain are zero.
template <class T>
void pair_reaction(const StateView<T>& view, int index, Vector3<T>* F, Vector3<T>* torque) {
  if (!view.layout.is_cut(index)) {
    forest_reaction(view, index, F, torque);
    return;
  }
  const Pair& pair = view.system.topology().pairs[static_cast<std::size_t>(index)];
  const PairTraits& traits = traits_of(pair.kind);
  const int row = view.layout.lambda_column(view.layout.pair_row[static_cast<std::size_t>(index)]);
  const auto lambda = [&view, row](int k) { return view.state->z[row + k]; };
  F->setZero();
  torque->setZero();
  int next = 0;
  if (traits.force == ForceRows::kAll) {
    const Vector3<T> on_child = view.state->z.template segment<3>(row);
    *F = view.design.constants.pairs[static_cast<std::size_t>(index)].C_i.transpose() * (view.body(pair.body_i).A.transpose() * on_child);
    next = 3;
  } else if (traits.force == ForceRows::kAcross) {
    *F = Vector3<T>(lambda(0), lambda(1), T(0.0));
    next = 2;
  } else if (traits.force == ForceRows::kAlong) {
    (*F)[2] = lambda(0);
    next = 1;
  }
  if (!traits.torque_rows || traits.rows < next + 2) return;
  (*torque)[1] = lambda(next);
  (*torque)[0] = -lambda(next + 1);
  if (traits.rows > next + 2) (*torque)[2] = lambda(next + 2);
}

/// The normal force N [N] in the bearing of a pair, theory (12); the kind of pair chooses the formula.
template <class T>
T normal_force(const StateView<T>& view, int pair) {
  const FrictionConstants<T>& c = view.design.constants.pairs[static_cast<std::size_t>(pair)].friction;
  Vector3<T> F, torque;
  pair_reaction(view, pair, &F, &torque);
  switch (traits_of(view.system.topology().pairs[static_cast<std::size_t>(pair)].kind).bearing) {
    case BearingLaw::kTranslational:
      return translational_normal_force(F, torque, c);
    case BearingLaw::kRevolute:
      return revolute_normal_force(F, torque, c);
    case BearingLaw::kPlane:
      return planar_normal_force(F, c);
    case BearingLaw::kBall:
      return ball_normal_force(F, c);
    case BearingLaw::kPin:
      break;
  }
  return pin_normal_force(F, torque, c);
}

}  // namespace codesign
