// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "elements/loads.h"
#include "elements/state_view.h"
#include "math/arrays.h"

namespace codesign {

// The rows of one free body: inertia, theory (9), gravity, the loads that other elements added to
// the workspace, theory (7), and the constraint row (p^T p - 1)/2 = 0 with its multiplier.

/// Inertia forces of (9), on the left of G: m r'' on the rows of r [N], and 4 G^T J G p'' + 8 G'^T
/// J G p' on the rows of p [N m].
template <class T>
void inertia_force(const BodyConstants<T>& body, const BodyKinematics<T>& k, Vector3<T>* on_r,
                   Vector4<T>* on_p) {
  const Vector3<T> y = 4.0 * (body.J * body_rate(k.p, k.pdd)),
                   w = 8.0 * (body.J * body_rate(k.p, k.pd));
  *on_r = body.mass * k.rdd;
  *on_p = body_rate_transposed(k.p, y) + body_rate_transposed(k.pd, w);
}

/// Adds m (r'' - g) + f to the rows of r [N] and 4 G^T J G p'' + 8 G'^T J G p' + K(W) p + lambda p
/// to the rows of p [N m], theory (7), (9). Does nothing for a body of the forest. Sets the body's
/// norm row to p^T p'' + p'^T p' [1/s^2]. All loads on bodies must be in `workspace` before.
template <class T>
void body_residual(const StateView<T>& view, Workspace<T>* workspace, std::size_t b,
                   VectorX<T>* G) {
  const BodyKinematics<T>& k = view.kinematics[b];
  if (!view.layout.is_free(static_cast<int>(b))) return;
  const int c = view.layout.column(static_cast<int>(b)),
            norm = view.layout.lambda_column(view.layout.norm_row(static_cast<int>(b)));
  Vector3<T> on_r;
  Vector4<T> on_p;
  inertia_force(view.design.constants.bodies[b], k, &on_r, &on_p);
  G->template segment<3>(c) +=
      on_r - view.design.constants.bodies[b].mass * view.design.gravity + workspace->loads[b].force;
  G->template segment<4>(c + 3) +=
      on_p + rotation_hessian_product(workspace->loads[b].W, k.p) + view.state->z[norm] * k.p;
  T sum(0.0);
  for (int e = 0; e < 4; ++e) sum += k.p[e] * k.pdd[e] + k.pd[e] * k.pd[e];
  (*G)[norm] = sum;
}

/// Sets the row |p| = 1 of Phi to (p^T p - 1)/2 and its rate to p^T p'.
template <class T>
void norm_error(const StateView<T>& view, int b, VectorX<T>* Phi, VectorX<T>* Phi_rate) {
  if (!view.layout.is_free(b)) return;
  const BodyKinematics<T>& k = view.body(b);
  T square(0.0), rate(0.0);
  for (int e = 0; e < 4; ++e) {
    square += k.p[e] * k.p[e];
    rate += k.p[e] * k.pd[e];
  }
  (*Phi)[view.layout.norm_row(b)] = 0.5 * (square - 1.0);
  (*Phi_rate)[view.layout.norm_row(b)] = rate;
}

// Rotors of actuators, theory (9a): the inertia forces of their spin, which is not part of the
// inertia of the bodies that carry them. The carrier is the body that carries the rotor; on the
// ground it contributes nothing. An armature, (9e), is a rotor of n = 1 without a carrier.

/// The rotor's constants and the motion of its carrier about the rotor's axis u; theory (9a).
template <class T>
struct RotorMotion {
  Vector3<T> axis;                                 ///< u, in the carrier's axes
  T ratio{1.0}, coupling{0.0};                     ///< n [- or rad/m], n J_r [kg m^2 or kg m]
  T carrier_rate{0.0}, carrier_acceleration{0.0};  ///< omega . u [rad/s], omega' . u [rad/s^2]
  Vector3<T> swing = Vector3<T>::Zero();           ///< omega x u, in the carrier's axes
};

/// Evaluates RotorMotion at the loaded state.
template <class T>
RotorMotion<T> rotor_motion(const StateView<T>& view, const Rotor& rotor) {
  const JointDynamicsConstants<T>& d = view.dynamics(rotor.pair, rotor.element);
  const BodyKinematics<T>& carrier = view.body(rotor.body);
  RotorMotion<T> m;
  if (rotor.is_armature) {
    m.axis.setZero();
    m.coupling = d.armature;
    return m;
  }
  m.axis = d.rotor_axis;
  m.ratio = d.gear_ratio;
  m.coupling = d.gear_ratio * d.rotor_inertia;
  if (carrier.at_rest) return m;
  if (carrier.in_forest) {
    m.carrier_rate = dot<T>(m.axis, carrier.omega);
    m.carrier_acceleration = dot<T>(m.axis, carrier.alpha);
    m.swing = cross<T>(carrier.omega, m.axis);
    return m;
  }
  m.carrier_rate = T(2.0) * dot<T>(m.axis, body_rate(carrier.p, carrier.pd));
  m.carrier_acceleration = T(2.0) * dot<T>(m.axis, body_rate(carrier.p, carrier.pdd));
  m.swing = T(2.0) * cross<T>(body_rate(carrier.p, carrier.pd), m.axis);
  return m;
}

/// The kinetic energy that the spin adds, n J_r theta' (n theta'/2 + u . omega_c) [J].
template <class T>
T rotor_energy(const StateView<T>& view, const Rotor& rotor) {
  const RotorMotion<T> m = rotor_motion(view, rotor);
  const T rate = view.coordinate(rotor.pair, rotor.element, CoordinateDetail::kRate).rate;
  return m.coupling * rate * (T(0.5) * m.ratio * rate + m.carrier_rate);
}

/// L = n J_r (n theta'' + u . omega_c'), the load of the rotor along the joint's coordinate [N or N
/// m], positive against it.
template <class T>
T rotor_load(const StateView<T>& view, const Rotor& rotor) {
  const RotorMotion<T> m = rotor_motion(view, rotor);
  return m.coupling *
         (m.ratio * view.coordinate(rotor.pair, rotor.element, CoordinateDetail::kAcceleration)
                        .acceleration +
          m.carrier_acceleration);
}

/// Adds J^T L to the rows of motion, and 2 G^T n J_r (theta'' u + theta' omega_c x u) to the rows
/// of the carrier's p.
template <class T>
void rotor_residual(const StateView<T>& view, Workspace<T>* workspace, const Rotor& rotor,
                    VectorX<T>* G) {
  const RotorMotion<T> m = rotor_motion(view, rotor);
  const CoordinateMotion<T>& joint =
      view.coordinate(rotor.pair, rotor.element, CoordinateDetail::kAcceleration);
  const T load = rotor_load(view, rotor);
  add_coordinate_load(view, workspace, rotor.pair, rotor.element, joint.J, load, G);
  if (rotor.body < 0) return;
  const Vector3<T> moment = m.coupling * (joint.acceleration * m.axis + joint.rate * m.swing);
  if (!view.layout.is_free(rotor.body)) {
    workspace->own[to_index(rotor.body)].moment += moment;
    return;
  }
  G->template segment<4>(view.layout.column(rotor.body) + 3) +=
      T(2.0) * body_rate_transposed(view.body(rotor.body).p, moment);
}

}  // namespace codesign
