// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>

#include "forces/friction_numbers.h"
#include "math/euler_parameters.h"
#include "math/scalar.h"

namespace codesign {

// The normal force N [N] in the bearing of a joint as a function of the reaction F'', T'' of theory
// (11): components in the joint axes, in the paper's sign, in which the child feels -F'' and -T''.
// Normal forces are even functions of the reaction.

/// Prismatic joint, theory (12): N = cabs f1x + cabs f1y + cabs f2x + cabs f2y + 2 cabs f3x +
/// preload, with Haug's resolution of the reaction into forces at the ends of the joint, theory
/// (11); a = joint_length, b = joint_width:
///   f1 = (-F_x + T_y/a, -F_y - T_x/a),  f2 = (-T_y/a, T_x/a),  f3 = T_z/(2b).
/// @param F F'' [N]. @param torque T'' [N m].
template <class T>
T translational_normal_force(const Vector3<T>& F, const Vector3<T>& torque,
                             const FrictionConstants<T>& c) {
  const T ia = 1.0 / c.joint_length, ib = 0.5 / c.joint_width;
  const T f1x = -F[0] + ia * torque[1], f1y = -F[1] - ia * torque[0], f2x = -ia * torque[1],
          f2y = ia * torque[0], f3x = ib * torque[2];
  const T n1x = smooth_abs(f1x, c.smoothing), n1y = smooth_abs(f1y, c.smoothing),
          n2x = smooth_abs(f2x, c.smoothing), n2y = smooth_abs(f2y, c.smoothing),
          n3x = smooth_abs(f3x, c.smoothing);
  return n1x + n1y + n2x + n2y + 2.0 * n3x + c.preload;
}

/// Pin of a cylindrical joint, theory (12):
///   N = (pi^3/24) (sqrt(f1x^2 + f1y^2 + eps^2) + sqrt(f2x^2 + f2y^2 + eps^2)) + preload,
/// from Haug's parabolic distribution of pressure. It does not depend on the choice of x''.
template <class T>
T pin_normal_force(const Vector3<T>& F, const Vector3<T>& torque, const FrictionConstants<T>& c) {
  using std::sqrt;
  constexpr double kParabolic = 31.00627668029982 / 24.0;  // pi^3 / 24
  const T ia = 1.0 / c.joint_length, e2 = c.smoothing * c.smoothing;
  const T f1x = -F[0] + ia * torque[1], f1y = -F[1] - ia * torque[0], f2x = -ia * torque[1],
          f2y = ia * torque[0];
  const T f1 = sqrt(f1x * f1x + f1y * f1y + e2), f2 = sqrt(f2x * f2x + f2y * f2y + e2);
  return kParabolic * (f1 + f2) + c.preload;
}

/// Revolute joint, theory (12): the pin's normal force plus r_z/r_e cabs(F_z), the axial force at
/// the arm r_z (friction_arm) referred to the pin's radius r_e (pin_radius).
template <class T>
T revolute_normal_force(const Vector3<T>& F, const Vector3<T>& torque,
                        const FrictionConstants<T>& c) {
  const T arm = is_less(T(0.0), c.pin_radius, true) ? T(c.friction_arm / c.pin_radius) : T(1.0);
  return pin_normal_force(F, torque, c) + arm * smooth_abs(F[2], c.smoothing);
}

/// Planar joint or table, theory (12): N = cabs(F_z) + preload. The joint holds in both directions
/// of the normal.
template <class T>
T planar_normal_force(const Vector3<T>& F, const Vector3<T>&, const FrictionConstants<T>& c) {
  return smooth_abs(F[2], c.smoothing) + c.preload;
}

/// Ball of a spherical joint, theory (12): N = sqrt(F.F + eps^2) + preload.
template <class T>
T ball_normal_force(const Vector3<T>& F, const Vector3<T>&, const FrictionConstants<T>& c) {
  using std::sqrt;
  return sqrt(dot(F, F) + c.smoothing * c.smoothing) + c.preload;
}

}  // namespace codesign
