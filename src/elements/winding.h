// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "elements/state_view.h"
#include "forces/control_law.h"
#include "forces/winding.h"
#include "math/arrays.h"

namespace codesign {

// Motors that a voltage moves, theory (9d).

template <class T>
const WindingConstants<T>& winding_numbers(const StateView<T>& view, const Winding& winding) {
  return view.dynamics(winding.pair, winding.element).winding;
}

/// Speed of the rotor relative to its carrier, w = n theta' [rad/s].
template <class T>
T rotor_speed(const StateView<T>& view, const Winding& winding) {
  return view.dynamics(winding.pair, winding.element).gear_ratio *
         view.coordinate(winding.pair, winding.element, CoordinateDetail::kRate).rate;
}

template <class T>
T drive_effort(const StateView<T>& view, int controller);

/// The voltage u [V], the sum of the controllers' outputs within the bus voltage (13c), and its
/// derivative by that sum.
template <class T>
SaturatedEffort<T> winding_voltage(const StateView<T>& view, const Winding& winding) {
  T demand(0.0);
  for (int controller : winding.controllers) demand += drive_effort(view, controller);
  const WindingConstants<T>& c = winding_numbers(view, winding);
  if (!c.is_bounded) return {demand, T(1.0)};
  return saturate(demand, c.bus_voltage);
}

/// The current at which i' = 0 at the present speed, (u - K w) / R [A].
template <class T>
T steady_current(const StateView<T>& view, const Winding& winding) {
  return winding_numbers(view, winding)
      .steady_current(winding_voltage(view, winding).value, rotor_speed(view, winding));
}

/// The current i of a winding that acts [A]: its state, or without an inductance steady_current().
template <class T>
T winding_current(const StateView<T>& view, const Winding& winding) {
  return winding.state >= 0 ? T(view.state->s[winding.state]) : steady_current(view, winding);
}

/// i' of a winding with a state [A/s].
template <class T>
T winding_current_rate(const StateView<T>& view, const Winding& winding) {
  return winding_numbers(view, winding)
      .current_rate(winding_voltage(view, winding).value, T(view.state->s[winding.state]),
                    rotor_speed(view, winding));
}

/// n K, effort per current [N m/A or N/A].
template <class T>
T effort_per_current(const StateView<T>& view, const Winding& winding) {
  return view.dynamics(winding.pair, winding.element).gear_ratio *
         winding_numbers(view, winding).torque_constant;
}

/// Sets the row i' - (u - R i - K w)/L = 0; nothing for a winding without a state.
template <class T>
void winding_residual(const StateView<T>& view, const Winding& winding, VectorX<T>* G) {
  if (winding.state < 0) return;
  const int row = view.layout.state_column(winding.state);
  (*G)[row] = view.state->z[row] - winding_current_rate(view, winding);
}

}  // namespace codesign
