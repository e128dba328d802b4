// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "joints/joint_sweep.h"
#include "math/arrays.h"
#include "mechanism/constants.h"
#include "system/system.h"

namespace codesign {

/// The motion of all bodies of a system with a forest, theory (56), and the poses of its pairs.
template <class T>
struct ForestMotion {
  std::vector<AxesMotion<T>> bodies;  ///< one per body, the ground last; empty without a forest
  std::vector<JointPose<T>> poses;    ///< per body: of the pair on which it hangs

  explicit ForestMotion(const Layout& layout) {
    if (!layout.has_forest()) return;
    bodies.resize(to_index(layout.bodies) + 1);
    poses.resize(to_index(layout.bodies));
  }

  /// The motion of a body; -1 is the ground.
  AxesMotion<T>& body(int index) { return index < 0 ? bodies.back() : bodies[to_index(index)]; }
  const AxesMotion<T>& body(int index) const {
    return index < 0 ? bodies.back() : bodies[to_index(index)];
  }
};

/// The motion of a free body from its kinematics.
template <class T>
void set_free_motion(const BodyKinematics<T>& k, const Vector3<T>& gravity, AxesMotion<T>* m) {
  m->A = k.A;
  m->r = k.r;
  m->velocity = k.A.transpose() * k.rd;
  m->omega = T(2.0) * body_rate(k.p, k.pd);
  m->alpha = T(2.0) * body_rate(k.p, k.pdd);
  m->acceleration = k.A.transpose() * Vector3<T>(k.rdd - gravity);
  m->update_turning();
}

/// The out sweep: the motion of the bodies that hang on pairs, parents before children. The motions
/// of free bodies must be set.
/// @param q, v, a coordinates, velocities and accelerations, Layout::n each.
template <class T>
void sweep_out(const System& system, const Constants<T>& constants, const Vector3<T>& gravity,
               const T* q, const T* v, const T* a, ForestMotion<T>* motion) {
  const Layout& layout = system.layout();
  motion->body(-1).acceleration = -gravity;
  for (int b : layout.forest.order) {
    const int pair = layout.forest.pair_above[to_index(b)], c = layout.column(b);
    const AxesMotion<T>& parent = motion->body(system.topology().pairs[to_index(pair)].body_i);
    JointPose<T>& pose = motion->poses[to_index(b)];
    pose = joint_pose(constants.pairs[to_index(pair)], q + c);
    motion->body(b) =
        move_child(parent, constants.pairs[to_index(pair)], pose, q + c, v + c, a + c);
  }
}

/// Euler parameters of a body's axes, the product of those of its pairs from the free body or the
/// ground on. They are continuous along a run, and of the sign that State::turns gives for it.
/// @param body -1: the ground
template <class T>
Vector4<T> body_parameters(const System& system, const Constants<T>& constants,
                           const State<T>& state, int body) {
  const Layout& layout = system.layout();
  Vector4<T> p(T(1.0), T(0.0), T(0.0), T(0.0));
  if (body < 0) return p;
  T sign(1.0);
  if (!layout.is_free(body)) sign = T(state.turns[to_index(layout.sign_slot + body)]);
  for (; body >= 0 && !layout.is_free(body);) {
    const auto pair = to_index(layout.forest.pair_above[to_index(body)]);
    p = quaternion_product<T>(
        joint_parameters(constants.pairs[pair], state.q.data() + layout.column(body)), p);
    body = system.topology().pairs[pair].body_i;
  }
  if (body >= 0) p = quaternion_product<T>(state.q.template segment<4>(layout.column(body) + 3), p);
  return sign * p;
}

/// The kinematics of a body of the forest as the elements read them.
template <class T>
void set_forest_kinematics(const AxesMotion<T>& m, const Vector3<T>& gravity,
                           BodyKinematics<T>* k) {
  k->in_forest = true;
  k->omega = m.omega;
  k->alpha = m.alpha;
  k->r = m.r;
  k->rd = m.A * m.velocity;
  k->rdd = m.A * m.acceleration + gravity;
  k->A = m.A;
  for (int column = 0; column < 3; ++column) {
    const Vector3<T> unit = Vector3<T>::Unit(column);
    k->Ad.col(column) = m.A * cross<T>(m.omega, unit);
    k->Add.col(column) = m.A * Vector3<T>(m.N.col(column));
  }
}

}  // namespace codesign
