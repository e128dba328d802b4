// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "forces/compliance.h"
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

/// The compliance of a gear at one design, at the joint's side; doc/theory.md (9c).
template <class T>
struct ElasticGearConstants {
  T stiffness{0.0}, damping{0.0};  ///< k [N m/rad or N/m], d [N m s/rad or N s/m]
  T backlash{0.0};                 ///< b [rad or m], unused unless `plays`
  bool plays = false;
};

/// The share of the backlash over which each flank comes into contact, w/b.
constexpr double kFlankWidth = 0.1;

/// By how much the flanks of a gear are pressed together, D(x) of doc/theory.md (9c) [rad or m]: x
/// without backlash, else the dead zone R(x - (b - w)/2) - R(-x - (b - w)/2) with R of
/// rounded_ramp(), w = b/10: zero for |x| <= (b - w)/2 and x -+ b/2 for |x| >= (b + w)/2.
/// @param x the motor's position less the joint's, both at the joint's side.
template <class T>
T flank_contact(const T& x, const ElasticGearConstants<T>& c) {
  if (!c.plays) return x;
  const T w = T(kFlankWidth) * c.backlash, edge = T(0.5) * (c.backlash - w);
  return rounded_ramp<T>(x - edge, w) - rounded_ramp<T>(-x - edge, w);
}

/// D'(x), 0 in the gap and 1 in contact.
template <class T>
T flank_contact_slope(const T& x, const ElasticGearConstants<T>& c) {
  if (!c.plays) return T(1.0);
  const T w = T(kFlankWidth) * c.backlash, edge = T(0.5) * (c.backlash - w);
  return rounded_ramp_slope<T>(x - edge, w) + rounded_ramp_slope<T>(-x - edge, w);
}

/// The torque tau = k D(x) + d D'(x) x' of an elastic gear on the joint [N m or N], doc/theory.md
/// (9c): the spring and damper of D, so that nothing acts in the gap.
/// @param rate x'.
template <class T>
T elastic_gear_torque(const T& x, const T& rate, const ElasticGearConstants<T>& c) {
  return c.stiffness * flank_contact(x, c) + c.damping * flank_contact_slope(x, c) * rate;
}

/// The elastic energy of an elastic gear, k times the integral of D from 0 to x [J].
template <class T>
T elastic_gear_energy(const T& x, const ElasticGearConstants<T>& c) {
  if (!c.plays) return T(0.5) * c.stiffness * x * x;
  const T w = T(kFlankWidth) * c.backlash, edge = T(0.5) * (c.backlash - w);
  return c.stiffness *
         (rounded_ramp_integral<T>(x - edge, w) + rounded_ramp_integral<T>(-x - edge, w));
}

}  // namespace codesign
