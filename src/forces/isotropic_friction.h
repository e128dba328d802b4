// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_FORCES_ISOTROPIC_FRICTION_H_
#define MECHANISM_CODESIGN_FORCES_ISOTROPIC_FRICTION_H_

#include <cmath>

#include "math/tanh_ratio.h"

namespace codesign {

/// Brown and McPhee's friction coefficient divided by the sliding speed s, as a function of s^2; analytic also at rest; doc/theory.md
/// (13a).
/// @param square s^2 [m^2/s^2], @param v_t transition velocity [m/s].
/// @return S(s)/s [s/m] and its derivative by s^2 [s^3/m^3].
template <class T>
ValueAndSlope<T> friction_per_speed(const T& square, const T& mu_static, const T& mu_dynamic, const T& v_t) {
  const T scale = T(1.0) / (v_t * v_t), w = square * scale;
  const ValueAndSlope<T> h = tanh_ratio<T>(T(16.0) * w);  // tanh(4u)/(4u), u = sqrt w
  const T d = T(0.25) * w + T(0.75);
  const T bump = (mu_static - mu_dynamic) / (d * d);
  return {(T(4.0) * mu_dynamic * h.value + bump) / v_t, (T(64.0) * mu_dynamic * h.slope - T(0.5) * bump / d) * scale / v_t};
}

/// The friction of a contact that slips in D directions, with the same coefficient in all of them.
template <class T, int D>
struct IsotropicFriction {
  using Vector = Eigen::Matrix<T, D, 1>;
  using Matrix = Eigen::Matrix<T, D, D>;

  Vector load = Vector::Zero();       ///< load L that opposes the slip, with the power -L . u [N]
  Matrix by_slip = Matrix::Zero();    ///< d load / d u [N s/m], symmetric
  Vector by_normal = Vector::Zero();  ///< d load / d N [-]
};

/// load = S(|u|) N u/|u|, theory (13a); zero at rest and analytic there.
/// @param u slip velocity [m/s], @param normal N [N].
template <class T, int D>
IsotropicFriction<T, D> isotropic_friction(const Eigen::Matrix<T, D, 1>& u, const T& normal, const T& mu_static, const T& mu_dynamic,
                                           const T& v_t) {
  T square(0.0);
  for (int k = 0; k < D; ++k) square += u[k] * u[k];
  const ValueAndSlope<T> sigma = friction_per_speed<T>(square, mu_static, mu_dynamic, v_t);
  IsotropicFriction<T, D> friction;
  friction.by_normal = sigma.value * u;
  friction.load = normal * friction.by_normal;
  const T curvature = T(2.0) * normal * sigma.slope;
  for (int row = 0; row < D; ++row)
    for (int column = 0; column < D; ++column)
      friction.by_slip(row, column) = curvature * u[row] * u[column] + (row == column ? normal * sigma.value : T(0.0));
  return friction;
}

/// The length of a vector, for signals. At zero, where it has no derivative, the derivative is set to zero.
template <class T, int D>
T length_of(const Eigen::Matrix<T, D, 1>& u) {
  using std::sqrt;
  T square(0.0);
  for (int k = 0; k < D; ++k) square += u[k] * u[k];
  return is_less(T(0.0), square, true) ? T(sqrt(square)) : T(0.0);
}

}  // namespace codesign

#endif  // MECHANISM_CODESIGN_FORCES_ISOTROPIC_FRICTION_H_
