// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "elements/joint_load.h"
#include "elements/winding.h"

namespace codesign {

// What observers see of the windings of motors, theory (9d), where they act, and where the motion
// is given and the effort tells the current.

/// i [A]: of the circuit, or effort / (n K).
template <class T>
T effective_current(const StateView<T>& view, const Winding& winding) {
  if (winding.acts) return winding_current(view, winding);
  return joint_effort(view, winding.pair, winding.element) / effort_per_current(view, winding);
}

/// u [V]: that of the controllers within the bus voltage, or R i + K w, which lacks L i'.
template <class T>
T terminal_voltage(const StateView<T>& view, const Winding& winding) {
  if (winding.acts) return winding_voltage(view, winding).value;
  const WindingConstants<T>& c = winding_numbers(view, winding);
  return c.resistance * effective_current(view, winding) +
         c.torque_constant * rotor_speed(view, winding);
}

/// u i, the power that the supply gives [W].
template <class T>
T electrical_power(const StateView<T>& view, const Winding& winding) {
  return terminal_voltage(view, winding) * effective_current(view, winding);
}

/// R i^2, the heat in the winding [W].
template <class T>
T copper_loss(const StateView<T>& view, const Winding& winding) {
  const T i = effective_current(view, winding);
  return winding_numbers(view, winding).resistance * i * i;
}

/// L i^2 / 2 [J].
template <class T>
T magnetic_energy(const StateView<T>& view, const Winding& winding) {
  const T i = effective_current(view, winding);
  return T(0.5) * winding_numbers(view, winding).inductance * i * i;
}

/// value(view, winding) of the motor that moves a joint's coordinate.
template <class T, class Value>
T of_motor(const StateView<T>& view, const CoordinateIndex& joint, const Value& value) {
  const CoordinateIndex motor = view.system.motor_of(joint.pair, joint.element);
  for (const Winding& winding : view.system.windings())
    if (winding.pair == motor.pair && winding.element == motor.element) return value(view, winding);
  return T(0.0);
}

/// The sum of value(view, winding) over all motors.
template <class T, class Value>
T sum_of_windings(const StateView<T>& view, const Value& value) {
  T sum(0.0);
  for (const Winding& winding : view.system.windings()) sum += value(view, winding);
  return sum;
}

}  // namespace codesign
