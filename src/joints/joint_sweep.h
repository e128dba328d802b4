// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cmath>

#include "joints/body_kinematics.h"
#include "joints/pair_constants.h"

namespace codesign {

// How a pair of the forest moves its body j, and how it carries the wrench on body j back to its
// coordinates and to body i; theory (56), (57). All vectors are in the axes of the body to which
// they belong.

/// The pose and the motion of a body, in its own axes.
template <class T>
struct AxesMotion {
  Matrix3<T> A = Matrix3<T>::Identity();  ///< body axes to ground axes
  Vector3<T> r = Vector3<T>::Zero();      ///< centre of mass, in ground axes [m]
  Vector3<T> velocity = Vector3<T>::Zero(), omega = Vector3<T>::Zero(),
             alpha = Vector3<T>::Zero();         ///< of the centre [m/s]; [rad/s]
  Vector3<T> acceleration = Vector3<T>::Zero();  ///< of the centre, less gravity [m/s^2]
  /// alpha~ + omega~ omega~: N s is the acceleration of a point s relative to the centre
  Matrix3<T> N = Matrix3<T>::Zero();

  /// Sets N from omega and alpha.
  void update_turning() {
    const T xx = omega[0] * omega[0], yy = omega[1] * omega[1], zz = omega[2] * omega[2];
    const T xy = omega[0] * omega[1], xz = omega[0] * omega[2], yz = omega[1] * omega[2];
    N << -(yy + zz), xy - alpha[2], xz + alpha[1],  //
        xy + alpha[2], -(xx + zz), yz - alpha[0],   //
        xz - alpha[1], yz + alpha[0], -(xx + yy);
  }
};

/// Force and moment about a body's centre of mass, in the body's axes [N], [N m].
template <class T>
struct Wrench {
  Vector3<T> force = Vector3<T>::Zero(), moment = Vector3<T>::Zero();

  Wrench& operator+=(const Wrench& other) {
    force += other.force;
    moment += other.moment;
    return *this;
  }
};

/// m (r'' - g) and J omega' + omega x J omega, the wrench that a body's own motion needs.
template <class T>
Wrench<T> inertia_wrench(const T& mass, const Matrix3<T>& J, const AxesMotion<T>& m) {
  return {mass * m.acceleration, J * m.alpha + cross<T>(m.omega, Vector3<T>(J * m.omega))};
}

/// The turns of a pair at its position.
template <class T>
struct JointPose {
  static constexpr std::size_t kMostTurns = 2;
  /// per turn, in order: the axes after it in those before it; the last one includes R_ij
  std::array<Matrix3<T>, kMostTurns> turn;
  Matrix3<T> R = Matrix3<T>::Identity();  ///< axes of body j in those of body i
};

/// exp(angle u~) R for a unit vector u. Three constant matrices, so that only their combination
/// depends on the angle.
template <class T>
Matrix3<T> turned(const Vector3<T>& u, const Matrix3<T>& R, const T& angle) {
  using std::cos;
  using std::sin;
  const T c = cos(angle), s = sin(angle);
  Matrix3<T> result;
  for (int k = 0; k < 3; ++k) {
    const Vector3<T> column = R.col(k), along = dot<T>(u, column) * u, across = column - along,
                     turn = cross<T>(u, column);
    for (int row = 0; row < 3; ++row) result(row, k) = along[row] + c * across[row] + s * turn[row];
  }
  return result;
}

namespace internal {

/// The number of turns of a pair, and the axis of one of its coordinates in the axes that move with
/// it: those of body i before the last turn, and those of body j from the last turn on (of a pair
/// without turns: always). At zero position both differ by R_ij only.
template <class T>
std::size_t turns_of(const PairConstants<T>& pair) {
  std::size_t turns = 0;
  for (const JointStep<T>& step : pair.steps) turns += step.turns ? 1 : 0;
  return turns;
}

template <class T>
Vector3<T> moving_axis(const PairConstants<T>& pair, std::size_t step, std::size_t turns_left) {
  return turns_left == 0 ? Vector3<T>(pair.R_ij.transpose() * pair.steps[step].axis)
                         : pair.steps[step].axis;
}

/// Changes to other axes: R has the new axes in the old ones as columns.
template <class T>
void change_axes(const Matrix3<T>& R, AxesMotion<T>* m) {
  for (Vector3<T>* x : {&m->velocity, &m->omega, &m->alpha, &m->acceleration})
    *x = Vector3<T>(R.transpose() * *x);
  m->A = Matrix3<T>(m->A * R);
}

/// Goes from the centre of mass to the point s; AxesMotion::N must be set.
template <class T>
void go_to(const Vector3<T>& s, AxesMotion<T>* m) {
  m->velocity += cross<T>(m->omega, s);
  m->acceleration += m->N * s;
  m->r += m->A * s;
}

}  // namespace internal

/// The turns of a pair at its position. @param q, v, a one entry per step of the pair, here and
/// below.
template <class T>
JointPose<T> joint_pose(const PairConstants<T>& pair, const T* q) {
  JointPose<T> pose;
  pose.R = pair.R_ij;
  std::size_t left = internal::turns_of(pair), turn = 0;
  for (std::size_t k = 0; k < pair.steps.size(); ++k) {
    if (!pair.steps[k].turns) continue;
    Matrix3<T>& R = pose.turn[turn];
    R = turned<T>(pair.steps[k].axis, left == 1 ? pair.R_ij : Matrix3<T>(Matrix3<T>::Identity()),
                  q[k]);
    pose.R = turn == 0 ? R : Matrix3<T>(pose.turn[0] * R);
    --left, ++turn;
  }
  return pose;
}

/// The same of a pair of one step, from the axes of its bodies.
template <class T>
JointPose<T> joint_pose_of(const Matrix3<T>& A_i, const Matrix3<T>& A_j) {
  JointPose<T> pose;
  pose.R = A_i.transpose() * A_j;
  pose.turn[0] = pose.R;
  return pose;
}

/// The motion of body j from that of body i, the pair's pose and its coordinates. @param q only the
/// entries of slides are read.
template <class T>
AxesMotion<T> move_child(const AxesMotion<T>& parent, const PairConstants<T>& pair,
                         const JointPose<T>& pose, const T* q, const T* v, const T* a) {
  AxesMotion<T> m = parent;
  internal::go_to(pair.s_i, &m);
  std::size_t left = internal::turns_of(pair), turn = 0;
  if (left == 0) internal::change_axes(pair.R_ij, &m);
  bool turned_since = left == 0;  // whether N is out of date
  for (std::size_t k = 0; k < pair.steps.size(); ++k) {
    if (pair.steps[k].turns) {
      internal::change_axes(pose.turn[turn], &m);
      --left, ++turn;
      const Vector3<T> u = internal::moving_axis(pair, k, left), rate = u * v[k];
      m.alpha += u * a[k] + cross<T>(m.omega, rate);
      m.omega += rate;
      turned_since = true;
      continue;
    }
    if (turned_since) m.update_turning();
    turned_since = false;
    const Vector3<T> u = internal::moving_axis(pair, k, left);
    internal::go_to(Vector3<T>(u * q[k]), &m);
    m.velocity += u * v[k];
    m.acceleration += u * a[k] + T(2.0) * cross<T>(m.omega, Vector3<T>(u * v[k]));
  }
  if (turned_since) m.update_turning();
  internal::go_to(Vector3<T>(-pair.s_j), &m);
  return m;
}

/// Euler parameters of body j's axes in those of body i: continuous in q, since they turn by half
/// of each angle.
template <class T>
Vector4<T> joint_parameters(const PairConstants<T>& pair, const T* q) {
  using std::cos;
  using std::sin;
  Vector4<T> p(T(1.0), T(0.0), T(0.0), T(0.0));
  for (std::size_t k = 0; k < pair.steps.size(); ++k) {
    if (!pair.steps[k].turns) continue;
    const T half = T(0.5) * q[k], s = sin(half);
    const Vector3<T>& u = pair.steps[k].axis;
    p = quaternion_product<T>(p, Vector4<T>(cos(half), s * u[0], s * u[1], s * u[2]));
  }
  return quaternion_product<T>(p, euler_parameters<T>(pair.R_ij));
}

/// Carries the wrench that the pair transmits to body j back to its coordinates, and to body i.
/// @param wrench about the centre of body j. @param q only the entries of slides are read. @param
/// rows receives the loads along the coordinates, one per step; overwritten.
/// @returns the wrench about the centre of body i, in its axes.
template <class T>
Wrench<T> carry_back(const Wrench<T>& wrench, const PairConstants<T>& pair,
                     const JointPose<T>& pose, const T* q, T* rows) {
  Wrench<T> w = wrench;
  w.moment -= cross<T>(pair.s_j, w.force);  // about the joint's point of body j
  std::size_t turn = internal::turns_of(pair), left = 0;
  for (std::size_t k = pair.steps.size(); k-- > 0;) {
    const Vector3<T> u = internal::moving_axis(pair, k, left);
    if (!pair.steps[k].turns) {
      rows[k] = dot<T>(u, w.force);
      w.moment += cross<T>(Vector3<T>(u * q[k]), w.force);
      continue;
    }
    rows[k] = dot<T>(u, w.moment);
    --turn, ++left;
    w.force = Vector3<T>(pose.turn[turn] * w.force);
    w.moment = Vector3<T>(pose.turn[turn] * w.moment);
  }
  if (internal::turns_of(pair) == 0) {
    w.force = Vector3<T>(pair.R_ij * w.force);
    w.moment = Vector3<T>(pair.R_ij * w.moment);
  }
  w.moment += cross<T>(pair.s_i, w.force);
  return w;
}

}  // namespace codesign
