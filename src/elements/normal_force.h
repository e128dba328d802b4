// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "elements/state_view.h"
#include "math/arrays.h"

// The normal force N in the bearing of a joint, computed from its reaction; theory (11), (12).
namespace codesign {

// Defined in elements/forest.h. Declared here because loads on bodies, of which it consists, may
// read normal forces of cut pairs.
/// The wrench that its joint transmits to a body of the forest, about the body's centre of mass, in
/// its axes; theory (57).
template <class T>
const Wrench<T>& transmitted_wrench(const StateView<T>& view, int body);

/// pair_reaction() of a pair of the forest: the part that the pair constrains of the wrench that it
/// transmits, about the point of body j.
template <class T>
void forest_reaction(const StateView<T>& view, int index, Vector3<T>* F, Vector3<T>* torque) {
  const JointLaw& joint = *view.pair(index).kind;
  const PairConstants<T>& pair = view.constants(index);
  const int body = view.layout.forest.body_below[to_index(index)];
  const Wrench<T>& wrench = transmitted_wrench(view, body);
  const Matrix3<T>& R = view.motion.poses[to_index(body)].R;
  const auto in_joint_axes = [&](const Vector3<T>& x) {
    return Vector3<T>(-(pair.C_i.transpose() * Vector3<T>(R * x)));
  };
  const Vector3<T> force = in_joint_axes(wrench.force);
  F->setZero();
  torque->setZero();
  if (joint.force == ForceRows::kAll) *F = force;
  if (joint.force == ForceRows::kAcross) *F = Vector3<T>(force[0], force[1], T(0.0));
  if (joint.force == ForceRows::kAlong) (*F)[2] = force[2];
  if (!joint.torque_rows) return;
  const Vector3<T> moment =
      in_joint_axes(Vector3<T>(wrench.moment - cross<T>(pair.s_j, wrench.force)));
  for (int k = 0; k < 2; ++k) (*torque)[k] = moment[k];
  if (joint.rows - joint.force_rows() > 2) (*torque)[2] = moment[2];
}

/// Reaction force F'' [N] and torque T'' [N m] in the joint axes of body i, read from the
/// multipliers, theory (11); the child feels -F'' and -T''. Components that the pair does not
/// constrain are zero.
template <class T>
void pair_reaction(const StateView<T>& view, int index, Vector3<T>* F, Vector3<T>* torque) {
  if (!view.layout.is_cut(index)) {
    forest_reaction(view, index, F, torque);
    return;
  }
  const Pair& pair = view.pair(index);
  const JointLaw& joint = *pair.kind;
  const int row = view.layout.lambda_column(view.layout.pair_row[to_index(index)]),
            next = row + joint.force_rows();
  const VectorX<T>& z = view.state->z;
  F->setZero();
  torque->setZero();
  if (joint.force == ForceRows::kAll) {
    const Vector3<T> on_child = z.template segment<3>(row);
    *F = view.constants(index).C_i.transpose() * (view.body(pair.body_i).A.transpose() * on_child);
  }
  if (joint.force == ForceRows::kAcross) *F = Vector3<T>(z[row], z[row + 1], T(0.0));
  if (joint.force == ForceRows::kAlongX) (*F)[0] = z[row];
  if (joint.force == ForceRows::kAlong) (*F)[2] = z[row];
  const int torques = joint.torque_rows ? joint.rows - joint.force_rows() : 0;
  if (torques > 0) (*torque)[1] = z[next];
  if (torques > 1) (*torque)[0] = -z[next + 1];
  if (torques > 2) (*torque)[2] = z[next + 2];
}

/// The normal force N [N] in the bearing of a pair, theory (12); its joint must have a BearingLaw.
template <class T>
T normal_force(const StateView<T>& view, int pair) {
  Vector3<T> F, torque;
  pair_reaction(view, pair, &F, &torque);
  return view.pair(pair).kind->bearing.normal_force.template of<T>(F, torque,
                                                                   view.constants(pair).friction);
}

}  // namespace codesign
