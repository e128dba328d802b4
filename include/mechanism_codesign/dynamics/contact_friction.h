// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_DYNAMICS_CONTACT_FRICTION_H_
#define MECHANISM_CODESIGN_DYNAMICS_CONTACT_FRICTION_H_

#include <array>

#include "mechanism_codesign/forces/isotropic_friction.h"
#include "mechanism_codesign/forces/normal_force.h"
#include "mechanism_codesign/joints/coordinate.h"

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

template <class T>
ContactFriction<T> contact_friction(PairKind kind, const PairConstants<T>& pair, const BodyKinematics<T>& i, const BodyKinematics<T>& j,
                                    const NormalForce<T>& normal, CoordinateDetail detail) {
  ContactFriction<T> contact;
  contact.normal = normal;
  contact.size = pair.slip.coordinates.size();
  contact.reported = kind == PairKind::kSpherical ? 3 : 2;
  Vector3<T> u = Vector3<T>::Zero(), arm = Vector3<T>::Zero();
  for (std::size_t k = 0; k < contact.size; ++k) {
    const auto e = static_cast<Eigen::Index>(k);
    contact.motion[k] = coordinate_motion(pair, pair.slip.coordinates[k], i, j, detail);
    arm[e] = pair.slip.arm[k];
    u[e] = arm[e] * contact.motion[k].rate;
  }
  const FrictionConstants<T>& f = pair.friction;
  const IsotropicFriction<T, 3> law = isotropic_friction<T, 3>(u, normal.value, f.mu_static, f.mu_dynamic, f.transition_velocity);
  for (std::size_t k = 0; k < contact.size; ++k) {
    const auto e = static_cast<Eigen::Index>(k);
    contact.load[e] = arm[e] * law.load[e] + pair.slip.viscous[k] * contact.motion[k].rate;
    contact.by_normal[e] = arm[e] * law.by_normal[e];
    for (Eigen::Index l = 0; l < 3; ++l) contact.by_rate(e, l) = arm[e] * law.by_slip(e, l) * arm[l];
    contact.by_rate(e, e) += pair.slip.viscous[k];
  }
  return contact;
}

}  // namespace codesign

#endif  // MECHANISM_CODESIGN_DYNAMICS_CONTACT_FRICTION_H_
