// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_FORCES_BRISTLE_H_
#define MECHANISM_CODESIGN_FORCES_BRISTLE_H_

#include "math/scalar.h"

namespace codesign {

/// The states of a friction law with bristles; theory (13e), (13f). They start at zero.
template <class T>
struct BristleState {
  Vector3<T> zeta = Vector3<T>::Zero();  ///< deflection times sigma_0, which is a friction per normal force [-]; one per slip direction
  T dwell{0.0};                          ///< s_dw [-]: 1 after a long rest, 0 while sliding; Gonthier's model only
};

/// Friction and the rates of the states at one instant, with their derivatives by the slip velocity u, zeta and s_dw.
template <class T>
struct Bristle {
  Vector3<T> mu = Vector3<T>::Zero();                                      ///< friction per normal force, opposing u [-]
  Matrix3<T> mu_u = Matrix3<T>::Zero(), mu_zeta = Matrix3<T>::Zero();      ///< [s/m], [-]
  Vector3<T> mu_dwell = Vector3<T>::Zero();                                ///< [-]
  Vector3<T> rate = Vector3<T>::Zero();                                    ///< zeta' [1/s]
  Matrix3<T> rate_u = Matrix3<T>::Zero(), rate_zeta = Matrix3<T>::Zero();  ///< [1/m], [1/s]
  T dwell_rate{0.0}, dwell_dwell{0.0};                                     ///< s_dw' and its derivative by s_dw [1/s]
  Vector3<T> dwell_u = Vector3<T>::Zero();                                 ///< derivative of s_dw' [1/m]
};

}  // namespace codesign

#endif  // MECHANISM_CODESIGN_FORCES_BRISTLE_H_
