// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "elements/state_view.h"
#include "forces/gear.h"
#include "math/arrays.h"

namespace codesign {

// Gears whose motor moves by itself, theory (9c).

template <class T>
const ElasticGearConstants<T>& elastic_constants(const StateView<T>& view, int gear) {
  const CoordinateIndex& joint = view.system.elastic_gears()[to_index(gear)].joint;
  return view.dynamics(joint.pair, joint.element).elastic;
}

/// x, the position of the motor less that of the joint [rad or m], at the joint's side.
template <class T>
T gear_deflection(const StateView<T>& view, int gear) {
  const ElasticGear& at = view.system.elastic_gears()[to_index(gear)];
  const T motor = view.coordinate_value(at.motor.pair, at.motor.element);
  return motor - view.coordinate_value(at.joint.pair, at.joint.element);
}

/// x' [rad/s or m/s].
template <class T>
T gear_deflection_rate(const StateView<T>& view, int gear) {
  const ElasticGear& at = view.system.elastic_gears()[to_index(gear)];
  const T motor = view.coordinate(at.motor.pair, at.motor.element, CoordinateDetail::kRate).rate;
  return motor - view.coordinate(at.joint.pair, at.joint.element, CoordinateDetail::kRate).rate;
}

/// The torque of spring and damper on the joint, positive along its coordinate [N m or N].
template <class T>
T elastic_torque(const StateView<T>& view, int gear) {
  return elastic_gear_torque<T>(gear_deflection(view, gear), gear_deflection_rate(view, gear),
                                elastic_constants(view, gear));
}

/// The elastic energy [J].
template <class T>
T elastic_energy(const StateView<T>& view, int gear) {
  return elastic_gear_energy<T>(gear_deflection(view, gear), elastic_constants(view, gear));
}

/// The power -d D'(x) x'^2 of the damper [W], never positive.
template <class T>
T elastic_power(const StateView<T>& view, int gear) {
  const ElasticGearConstants<T>& c = elastic_constants(view, gear);
  const T rate = gear_deflection_rate(view, gear);
  return -c.damping * flank_contact_slope<T>(gear_deflection(view, gear), c) * rate * rate;
}

/// The elastic gear of a joint's coordinate; -1: its gear is rigid.
inline int elastic_gear_of(const System& system, int pair, int element) {
  const std::vector<ElasticGear>& gears = system.elastic_gears();
  for (std::size_t k = 0; k < gears.size(); ++k)
    if (gears[k].joint == CoordinateIndex{pair, element}) return static_cast<int>(k);
  return -1;
}

}  // namespace codesign
