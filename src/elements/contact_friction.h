// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_ELEMENTS_CONTACT_FRICTION_H_
#define MECHANISM_CODESIGN_ELEMENTS_CONTACT_FRICTION_H_

#include <array>

#include "forces/bristle_law.h"
#include "forces/isotropic_friction.h"
#include "forces/normal_force.h"
#include "joints/coordinate.h"

namespace codesign {

/// Isotropic friction of one pair (a table, a planar or a spherical joint) at one instant, over its slip coordinates; theory (13a).
template <class T>
struct ContactFriction {
  std::size_t size = 0;      ///< slip coordinates
  std::size_t reported = 0;  ///< those that make up the reported speed and friction: a plane's slides, all of a ball's
  std::array<CoordinateMotion<T>, 3> motion;
  NormalForce<T> normal;
  Vector3<T> load = Vector3<T>::Zero();       ///< against each rate [N or N m]
  Matrix3<T> by_rate = Matrix3<T>::Zero();    ///< d load / d rate
  Vector3<T> by_normal = Vector3<T>::Zero();  ///< d load / d N
  Matrix3<T> by_zeta = Matrix3<T>::Zero();    ///< d load / d deflection, of a law with states
  Vector3<T> by_dwell = Vector3<T>::Zero();   ///< d load / d s_dw

  /// Speed of the joint's point [m/s], or of a ball's turn [rad/s].
  T speed() const {
    Vector3<T> rate = Vector3<T>::Zero();
    for (std::size_t k = 0; k < reported; ++k) rate[static_cast<Eigen::Index>(k)] = motion[k].rate;
    return length_of<T, 3>(rate);
  }
  /// Magnitude of the force [N], or of a ball's torque [N m].
  T magnitude() const {
    Vector3<T> part = load;
    if (reported < 3) part[2] = T(0.0);
    return length_of<T, 3>(part);
  }
  /// Power that friction takes from the motion [W].
  T power() const {
    T sum(0.0);
    for (std::size_t k = 0; k < size; ++k) sum += load[static_cast<Eigen::Index>(k)] * motion[k].rate;
    return sum;
  }
};

/// Slip over one to three coordinates: their motion, and u [m/s], each rate times its arm.
template <class T>
struct ContactSlip {
  std::array<CoordinateMotion<T>, 3> motion{};
  Vector3<T> arm = Vector3<T>::Zero(), u = Vector3<T>::Zero();
};

/// That of a pair with isotropic friction.
template <class T>
ContactSlip<T> contact_slip(const PairConstants<T>& pair, const BodyKinematics<T>& i, const BodyKinematics<T>& j, CoordinateDetail detail) {
  ContactSlip<T> slip;
  for (std::size_t k = 0; k < pair.slip.coordinates.size(); ++k) {
    const auto e = static_cast<Eigen::Index>(k);
    slip.motion[k] = coordinate_motion(pair, pair.slip.coordinates[k], i, j, detail);
    slip.arm[e] = pair.slip.arm[k];
    slip.u[e] = slip.arm[e] * slip.motion[k].rate;
  }
  return slip;
}

/// @param bristle the pair's law with states, or null. @param s extra states.
template <class T>
ContactFriction<T> contact_friction(PairKind kind, const PairConstants<T>& pair, const BodyKinematics<T>& i, const BodyKinematics<T>& j,
                                    const NormalForce<T>& normal, const BristleContact* bristle, const VectorX<T>& s,
                                    CoordinateDetail detail) {
  const ContactSlip<T> slip = contact_slip(pair, i, j, detail);
  const FrictionConstants<T>& f = pair.friction;
  ContactFriction<T> contact;
  contact.motion = slip.motion;
  contact.normal = normal;
  contact.size = pair.slip.coordinates.size();
  contact.reported = static_cast<std::size_t>(traits_of(kind).slips_of_the_point);
  IsotropicFriction<T, 3> law;
  if (bristle) {
    const Bristle<T> b = bristle_law<T>(*bristle, slip.u, s, f);
    law = {normal.value * b.mu, normal.value * b.mu_u, b.mu};
    for (Eigen::Index e = 0; e < 3; ++e) contact.by_zeta.row(e) = (slip.arm[e] * normal.value) * b.mu_zeta.row(e);
    for (Eigen::Index e = 0; e < 3; ++e) contact.by_dwell[e] = slip.arm[e] * normal.value * b.mu_dwell[e];
  } else {
    law = isotropic_friction<T, 3>(slip.u, normal.value, f.mu_static, f.mu_dynamic, f.transition_velocity);
  }
  for (std::size_t k = 0; k < contact.size; ++k) {
    const auto e = static_cast<Eigen::Index>(k);
    contact.load[e] = slip.arm[e] * law.load[e] + pair.slip.viscous[k] * contact.motion[k].rate;
    contact.by_normal[e] = slip.arm[e] * law.by_normal[e];
    for (Eigen::Index l = 0; l < 3; ++l) contact.by_rate(e, l) = slip.arm[e] * law.by_slip(e, l) * slip.arm[l];
    contact.by_rate(e, e) += pair.slip.viscous[k];
  }
  return contact;
}

}  // namespace codesign

#endif  // MECHANISM_CODESIGN_ELEMENTS_CONTACT_FRICTION_H_
