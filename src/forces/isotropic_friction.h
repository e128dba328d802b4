// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>

#include "math/tanh_ratio.h"

namespace codesign {

/// Brown and McPhee's friction coefficient divided by the sliding speed s, as a function of s^2; analytic also at rest; doc/theory.md
/// (13a).
/// @param square s^2 [m^2/s^2], @param v_t transition velocity [m/s].
/// @return S(s)/s [s/m].
template <class T>
T friction_per_speed(const T& square, const T& mu_static, const T& mu_dynamic, const T& v_t) {
  const T scale = T(1.0) / (v_t * v_t), w = square * scale;
  const T h = tanh_ratio<T>(T(16.0) * w);  // tanh(4u)/(4u), u = sqrt w
  const T d = T(0.25) * w + T(0.75);
  return (T(4.0) * mu_dynamic * h + (mu_static - mu_dynamic) / (d * d)) / v_t;
}

/// The load L = S(|u|) N u/|u| [N] of a contact that slips in D directions, with the same coefficient in all of them, theory (13a). It
/// opposes the slip, with the power -L . u; zero at rest.
/// @param u slip velocity [m/s], @param normal N [N], @param per_speed S(|u|)/|u| [s/m] as a function of u.u.
template <class T, int D, class PerSpeed>
Eigen::Matrix<T, D, 1> isotropic_friction(const Eigen::Matrix<T, D, 1>& u, const T& normal, const PerSpeed& per_speed) {
  T square(0.0);
  for (int k = 0; k < D; ++k) square += u[k] * u[k];
  const T sigma = per_speed(square);
  return normal * (sigma * u);
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
