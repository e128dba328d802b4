// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "math/scalar.h"

namespace codesign {

/// The circuit of a DC motor at one design, doc/theory.md (9d):
///   L i' = u - R i - K n theta',   torque on the rotor K i, effort on the joint n K i.
template <class T>
struct WindingConstants {
  T resistance{1.0}, inductance{0.0};  ///< R [ohm], L [H]
  T torque_constant{0.0};              ///< K [N m/A = V s/rad]
  T bus_voltage{0.0};                  ///< [V], valid if `is_bounded`
  bool is_bounded = false;

  /// The current of L = 0, (u - K w) / R [A]. @param u [V]. @param w = n theta' [rad/s].
  T steady_current(const T& u, const T& w) const { return (u - torque_constant * w) / resistance; }
  /// i' [A/s]; L > 0.
  T current_rate(const T& u, const T& i, const T& w) const {
    return (u - resistance * i - torque_constant * w) / inductance;
  }
};

}  // namespace codesign
