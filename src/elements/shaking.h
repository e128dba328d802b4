// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "elements/body.h"
#include "elements/link_axes.h"
#include "elements/state_view.h"
#include "math/arrays.h"

namespace codesign {

// What the motion of all bodies exerts on the ground, theory (11b): the sums of their inertia
// forces, -P' and -H', without weight and loads.

/// One component of F = -sum m r'' [N].
template <class T>
T shaking_force(const StateView<T>& view, const SignalReference& of) {
  Vector3<T> force = Vector3<T>::Zero();
  for (int b = 0; b < view.layout.bodies; ++b)
    force -= view.design.constants.bodies[to_index(b)].mass * view.body(b).rdd;
  return component_of(view, of, force);
}

/// One component of M = -sum ((r - o) x m r'' + A (J omega' + omega x J omega)), less the rate of
/// the spin of the rotors (9a) [N m]. o is the ground's origin, or the present place of the origin
/// of the link in whose axes M is told.
template <class T>
T shaking_moment(const StateView<T>& view, const SignalReference& of) {
  Vector3<T> moment = Vector3<T>::Zero(), o = Vector3<T>::Zero();
  if (of.axes >= 0) {
    const BodyKinematics<T>& k = view.body(view.system.topology().link_body[to_index(of.axes)]);
    o = k.r + k.A * view.design.constants.links[to_index(of.axes)].s;
  }
  for (int b = 0; b < view.layout.bodies; ++b) {
    const BodyKinematics<T>& k = view.body(b);
    const BodyConstants<T>& c = view.design.constants.bodies[to_index(b)];
    const Vector3<T> omega = body_omega(k), spin = c.J * omega,
                     turning = c.J * body_alpha(k) + cross<T>(omega, spin), arm = k.r - o,
                     inertia = c.mass * k.rdd;
    moment -= cross<T>(arm, inertia) + k.A * turning;
  }
  for (const Rotor& rotor : view.system.rotors()) {
    const RotorMotion<T> m = rotor_motion(view, rotor);
    const CoordinateMotion<T>& joint =
        view.coordinate(rotor.pair, rotor.element, CoordinateDetail::kAcceleration);
    const Vector3<T> spin = m.coupling * (joint.acceleration * m.axis + joint.rate * m.swing);
    moment -= view.body(rotor.body).A * spin;
  }
  return component_of(view, of, moment);
}

}  // namespace codesign
