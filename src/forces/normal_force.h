// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_FORCES_NORMAL_FORCE_H_
#define MECHANISM_CODESIGN_FORCES_NORMAL_FORCE_H_

#include <cmath>

#include "math/elementary.h"
#include "math/euler_parameters.h"
#include "mechanism/constants.h"

namespace codesign {

/// A normal force with its gradient by the reaction F'', T'' of theory (11): components in the joint axes, in the paper's sign, in which
/// the child feels -F'' and -T''. Normal forces are even functions of the reaction.
template <class T>
struct NormalForce {
  T value{0.0};                            ///< [N]
  Vector3<T> F = Vector3<T>::Zero();       ///< dN/dF'' [-]
  Vector3<T> torque = Vector3<T>::Zero();  ///< dN/dT'' [1/m]
};

/// Prismatic joint, theory (12): N = cabs f1x + cabs f1y + cabs f2x + cabs f2y + 2 cabs f3x + preload, with Haug's resolution of the
/// reaction into forces at the ends of the joint, theory (11); a = joint_length, b = joint_width:
///   f1 = (-F_x + T_y/a, -F_y - T_x/a),  f2 = (-T_y/a, T_x/a),  f3 = T_z/(2b).
/// @param F F'' [N]. @param torque T'' [N m].
template <class T>
NormalForce<T> translational_normal_force(const Vector3<T>& F, const Vector3<T>& torque, const FrictionConstants<T>& c) {
  const T ia = 1.0 / c.joint_length, ib = 0.5 / c.joint_width;
  const T f1x = -F[0] + ia * torque[1], f1y = -F[1] - ia * torque[0], f2x = -ia * torque[1], f2y = ia * torque[0], f3x = ib * torque[2];
  const T n1x = smooth_abs(f1x, c.smoothing), n1y = smooth_abs(f1y, c.smoothing), n2x = smooth_abs(f2x, c.smoothing),
          n2y = smooth_abs(f2y, c.smoothing), n3x = smooth_abs(f3x, c.smoothing);
  NormalForce<T> N;
  N.value = n1x + n1y + n2x + n2y + 2.0 * n3x + c.preload;
  N.F[0] = -f1x / n1x;
  N.F[1] = -f1y / n1y;
  N.torque[0] = ia * (f2y / n2y - f1y / n1y);
  N.torque[1] = ia * (f1x / n1x - f2x / n2x);
  N.torque[2] = 2.0 * ib * f3x / n3x;
  return N;
}

/// Pin of a cylindrical joint, theory (12): N = (pi^3/24) (sqrt(f1x^2 + f1y^2 + eps^2) + sqrt(f2x^2 + f2y^2 + eps^2)) + preload, from
/// Haug's parabolic distribution of pressure. It does not depend on the choice of x''.
template <class T>
NormalForce<T> pin_normal_force(const Vector3<T>& F, const Vector3<T>& torque, const FrictionConstants<T>& c) {
  using std::sqrt;
  constexpr double kParabolic = 31.00627668029982 / 24.0;  // pi^3 / 24
  const T ia = 1.0 / c.joint_length, e2 = c.smoothing * c.smoothing;
  const T f1x = -F[0] + ia * torque[1], f1y = -F[1] - ia * torque[0], f2x = -ia * torque[1], f2y = ia * torque[0];
  const T f1 = sqrt(f1x * f1x + f1y * f1y + e2), f2 = sqrt(f2x * f2x + f2y * f2y + e2);
  const T k1 = T(kParabolic) / f1, k2 = T(kParabolic) / f2;
  NormalForce<T> N;
  N.value = kParabolic * (f1 + f2) + c.preload;
  N.F[0] = -k1 * f1x;
  N.F[1] = -k1 * f1y;
  N.torque[0] = ia * (k2 * f2y - k1 * f1y);
  N.torque[1] = ia * (k1 * f1x - k2 * f2x);
  return N;
}

/// Revolute joint, theory (12): the pin's normal force plus r_z/r_e cabs(F_z), the axial force at the arm r_z (friction_arm) referred to
/// the pin's radius r_e (pin_radius).
template <class T>
NormalForce<T> revolute_normal_force(const Vector3<T>& F, const Vector3<T>& torque, const FrictionConstants<T>& c) {
  NormalForce<T> N = pin_normal_force(F, torque, c);
  const T thrust = smooth_abs(F[2], c.smoothing);
  const T arm = is_less(T(0.0), c.pin_radius, true) ? T(c.friction_arm / c.pin_radius) : T(1.0);
  N.value += arm * thrust;
  N.F[2] = arm * F[2] / thrust;
  return N;
}

/// Planar joint or table, theory (12): N = cabs(F_z) + preload. The joint holds in both directions of the normal.
template <class T>
NormalForce<T> planar_normal_force(const Vector3<T>& F, const FrictionConstants<T>& c) {
  const T load = smooth_abs(F[2], c.smoothing);
  NormalForce<T> N;
  N.value = load + c.preload;
  N.F[2] = F[2] / load;
  return N;
}

/// Ball of a spherical joint, theory (12): N = sqrt(F.F + eps^2) + preload.
template <class T>
NormalForce<T> ball_normal_force(const Vector3<T>& F, const FrictionConstants<T>& c) {
  using std::sqrt;
  const T load = sqrt(dot(F, F) + c.smoothing * c.smoothing);
  NormalForce<T> N;
  N.value = load + c.preload;
  N.F = F / load;
  return N;
}

}  // namespace codesign

#endif  // MECHANISM_CODESIGN_FORCES_NORMAL_FORCE_H_
