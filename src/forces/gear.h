// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "forces/friction_numbers.h"
#include "math/scalar.h"

namespace codesign {

/// The losses of an actuator's gear and motor at one design; doc/theory.md (9b).
template <class T>
struct GearConstants {
  T driving{0.0};      ///< c_d [-]: 1/eta - 1, lost per transmitted torque that moves the joint
  T backdriving{0.0};  ///< c_b [-]: 1 - eta_b, lost per transmitted torque that the joint moves
  T coulomb{0.0};      ///< |n| T_c of the motor's side [N m or N]
  T viscous{0.0};      ///< n^2 b of the motor's side [N m s/rad or N s/m]
  /// The law of the flanks, with mu_s = mu_d = 1: its transition velocity as a rate of the joint,
  /// its bristles, and epsilon of the smooth absolute value of the torque.
  FrictionConstants<T> slip;
};

/// The torque that a gear loses [N m or N], positive against the joint's coordinate; doc/theory.md
/// (9b):
///   mu ((c_d + c_b)/2 cabs(tau) + mu (c_d - c_b)/2 tau),
/// which is c_d |tau| where tau drives the motion (mu = 1, tau > 0) and c_b |tau| where the motion
/// drives tau. Its power -mu rate (...) is never positive for |mu| <= 1 and c_d, c_b >= 0.
/// @param tau torque that the gear transmits to the joint, positive along the coordinate [N m or
/// N].
/// @param mu friction of the flanks per pressure, of the sign of the joint's rate, -1 ... 1 [-].
template <class T>
T gear_loss(const T& tau, const T& mu, const GearConstants<T>& c) {
  const T mean = 0.5 * (c.driving + c.backdriving), more = 0.5 * (c.driving - c.backdriving);
  return mu * (mean * smooth_abs(tau, c.slip.smoothing) + mu * more * tau);
}

}  // namespace codesign
