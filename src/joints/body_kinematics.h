// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "math/euler_parameters.h"

namespace codesign {

/// The number of coordinates of a free body, [r, p].
constexpr int kBodySize = 7;

/// Position, velocity and acceleration of a body's frame: centre of mass r, Euler parameters p,
/// rotation matrix A, with first (d) and second (dd) time derivatives; doc/theory.md (1). The
/// ground is a body at rest at the origin. [m], [m/s], [m/s^2]; [-], [1/s], [1/s^2].
template <class T>
struct BodyKinematics {
  Vector3<T> r = Vector3<T>::Zero(), rd = Vector3<T>::Zero(), rdd = Vector3<T>::Zero();
  Vector4<T> p = Vector4<T>(T(1.0), T(0.0), T(0.0), T(0.0)), pd = Vector4<T>::Zero(),
             pdd = Vector4<T>::Zero();
  Matrix3<T> A = Matrix3<T>::Identity(), Ad = Matrix3<T>::Zero(), Add = Matrix3<T>::Zero();
  bool at_rest = false;  ///< the body is the ground: vectors fixed in it are constants
  /// The body hangs on a pair of the forest, theory (56): p and its derivatives are not known, but
  /// omega and alpha are.
  bool in_forest = false;
  Vector3<T> omega = Vector3<T>::Zero(),
             alpha = Vector3<T>::Zero();  ///< angular velocity and acceleration, in the body's axes

  /// Fills A, Ad = DA(p)[p'], Add = DA(p)[p''] + 2 A(p') from p, pd, pdd.
  void update_rotation() {
    A = rotation(p);
    Ad = rotation_derivative(p, pd);
    Add = rotation_derivative(p, pdd) + 2.0 * rotation(pd);
  }
};

/// Angular velocity in the body's axes [rad/s]; theory (4).
template <class T>
Vector3<T> body_omega(const BodyKinematics<T>& body) {
  return body.in_forest ? body.omega : Vector3<T>(T(2.0) * body_rate(body.p, body.pd));
}

/// Angular acceleration in the body's axes [rad/s^2].
template <class T>
Vector3<T> body_alpha(const BodyKinematics<T>& body) {
  return body.in_forest ? body.alpha : Vector3<T>(T(2.0) * body_rate(body.p, body.pdd));
}

/// Angular velocity in ground axes [rad/s]; theory (4).
template <class T>
Vector3<T> ground_omega(const BodyKinematics<T>& body) {
  return body.in_forest ? Vector3<T>(body.A * body.omega)
                        : Vector3<T>(T(2.0) * (ground_rate_matrix(body.p) * body.pd));
}

/// A vector that moves with the bodies, in ground axes, with its first and second time derivative.
template <class T>
struct VectorMotion {
  Vector3<T> x, xd, xdd;
};

/// Motion of the body-fixed direction A a.
template <class T>
VectorMotion<T> direction_motion(const BodyKinematics<T>& body, const Vector3<T>& a) {
  if (body.at_rest) return {a, Vector3<T>::Zero(), Vector3<T>::Zero()};
  return {body.A * a, body.Ad * a, body.Add * a};
}

/// Motion of the body-fixed point r + A s.
template <class T>
VectorMotion<T> point_motion(const BodyKinematics<T>& body, const Vector3<T>& s) {
  VectorMotion<T> x = direction_motion(body, s);
  if (body.at_rest) return x;
  x.x += body.r;
  x.xd += body.rd;
  x.xdd += body.rdd;
  return x;
}

/// Motion of the vector from point s_i of body i to point s_j of body j.
template <class T>
VectorMotion<T> displacement_motion(const BodyKinematics<T>& i, const Vector3<T>& s_i,
                                    const BodyKinematics<T>& j, const Vector3<T>& s_j) {
  const VectorMotion<T> to = point_motion(j, s_j), from = point_motion(i, s_i);
  return {to.x - from.x, to.xd - from.xd, to.xdd - from.xdd};
}

}  // namespace codesign
