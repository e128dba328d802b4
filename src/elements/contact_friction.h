// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>

#include "forces/bristle_law.h"
#include "forces/isotropic_friction.h"
#include "joints/coordinate.h"

namespace codesign {

/// The friction of one joint coordinate at one instant, for observers; theory (13).
template <class T>
struct FrictionState {
  T velocity{0.0};  ///< rate of the coordinate, child relative to parent [m/s or rad/s]
  T normal{0.0};    ///< normal force N [N]; zero for `<dynamics friction>`
  T load{0.0};      ///< L, positive against the motion, viscous part included [N or N m]; the child feels -L
};

/// Isotropic friction of one pair (a table, a planar or a spherical joint) at one instant; theory (13a). Vectors have one entry per slip
/// coordinate; entries beyond `size` are zero.
template <class T>
struct ContactFriction {
  std::size_t size = 0;      ///< number of slip coordinates: 2 for a table, 3 for planar and spherical joints
  std::size_t reported = 0;  ///< the first ones make up the reported speed and friction: two slides of a plane, all three of a ball
  std::array<CoordinateMotion<T>, 3> motion;
  T normal{0.0};                         ///< N [N], theory (12)
  Vector3<T> load = Vector3<T>::Zero();  ///< L, positive against the rate, viscous part included [N or N m]

  /// Speed of the joint's point [m/s], or |omega| of a ball [rad/s].
  T speed() const {
    Vector3<T> rate = Vector3<T>::Zero();
    for (std::size_t k = 0; k < reported; ++k) rate[static_cast<Eigen::Index>(k)] = motion[k].rate;
    return length_of<T, 3>(rate);
  }
  /// Magnitude of the friction force [N], or of the friction torque of a ball [N m].
  T magnitude() const {
    Vector3<T> part = load;
    if (reported < 3) part[2] = T(0.0);
    return length_of<T, 3>(part);
  }
  /// Power that friction takes from the motion, L . rates [W].
  T power() const {
    T sum(0.0);
    for (std::size_t k = 0; k < size; ++k) sum += load[static_cast<Eigen::Index>(k)] * motion[k].rate;
    return sum;
  }
};

/// The slip of a contact in one to three coordinates: their motion, their arms (1 for a slide, a radius [m] for a turn), and u, each rate
/// times its arm [m/s].
template <class T>
struct ContactSlip {
  std::array<CoordinateMotion<T>, 3> motion{};
  Vector3<T> arm = Vector3<T>::Zero(), u = Vector3<T>::Zero();
};

/// The slip of a pair with isotropic friction. @param i, j motion of its two bodies.
template <class T>
ContactSlip<T> contact_slip(const PairConstants<T>& pair, const BodyKinematics<T>& i, const BodyKinematics<T>& j) {
  ContactSlip<T> slip;
  for (std::size_t k = 0; k < pair.slip.coordinates.size(); ++k) {
    const auto e = static_cast<Eigen::Index>(k);
    slip.motion[k] = coordinate_motion(pair, pair.slip.coordinates[k], i, j, CoordinateDetail::kRate);
    slip.arm[e] = pair.slip.arm[k];
    slip.u[e] = slip.arm[e] * slip.motion[k].rate;
  }
  return slip;
}

}  // namespace codesign
