// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "math/scalar.h"

namespace codesign {

/// The states of a friction law with bristles; theory (13e), (13f). They start at zero.
template <class T>
struct BristleState {
  Vector3<T> zeta = Vector3<T>::Zero();  ///< deflection times sigma_0, which is a friction per normal force [-]; one per slip direction
  T dwell{0.0};                          ///< s_dw [-]: 1 after a long rest, 0 while sliding; Gonthier's model only
};

/// Friction and the rates of the states at one instant.
template <class T>
struct Bristle {
  Vector3<T> mu = Vector3<T>::Zero();    ///< friction per normal force, opposing u [-]
  Vector3<T> rate = Vector3<T>::Zero();  ///< zeta' [1/s]
  T dwell_rate{0.0};                     ///< s_dw' [1/s]
};

}  // namespace codesign
