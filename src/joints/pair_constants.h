// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <utility>
#include <vector>

#include "forces/friction_numbers.h"
#include "forces/gear.h"
#include "forces/winding.h"
#include "math/scalar.h"

namespace codesign {

/// The constants from which a joint coordinate theta is computed from the bodies' coordinates;
/// theory (8).
template <class T>
struct CoordinateConstants {
  enum class Kind {
    /// not available: the joint has no scalar position, or the folded chain no closed form for it
    kNone,
    kTurn,  ///< turn about the common z axis: sign * atan2(y_i . x_j, x_i . x_j)
    /// sign * a . d, with a fixed in body i or j and d from the joint point of i to the joint point
    /// of j
    kSlide,
    kAngle,  ///< sign * atan2(a_i . b_j, c_i . d_j)
    kSine,   ///< offset + sign * asin(a_i . b_j)
    kSpin    ///< only a rate: a . (omega_j - omega_i), with a fixed in the ground
  };
  Kind kind = Kind::kNone;
  double sign = 1.0;        ///< -1 where URDF's coordinate has the opposite direction
  bool fixed_in_j = false;  ///< kSlide: a is fixed in body j, else in body i
  T offset{0.0};            ///< kSine [rad]
  Vector3<T> a = Vector3<T>::Zero(), b = Vector3<T>::Zero(), c = Vector3<T>::Zero(),
             d = Vector3<T>::Zero();
};

/// A contact that slips in several directions at once, theory (13a). Component k of its slip
/// velocity is arm[k] times the rate of coordinates[k].
template <class T>
struct SlipConstants {
  /// empty, two (table) or three (planar, spherical)
  std::vector<CoordinateConstants<T>> coordinates;
  std::array<T, 3> arm{T(1.0), T(1.0), T(1.0)};      ///< 1 for a slide, r_e [m] for a turn
  std::array<T, 3> viscous{T(0.0), T(0.0), T(0.0)};  ///< viscous load per rate [N s/m or N m s/rad]
};

/// The numbers of a joint's stops; theory (13d).
template <class T>
struct StopConstants {
  T stiffness{1.0};    ///< k [N/m or N m/rad]
  T dissipation{0.0};  ///< c [s/m or s/rad]
  T width{1.0};        ///< w [m or rad]
};

/// `<dynamics>`, `<limit>`, torsion spring and actuator of one joint. Units as in JointDescription.
template <class T>
struct JointDynamicsConstants {
  T damping{0.0}, dry_friction{0.0};                          ///< `<dynamics>`
  T stiffness{0.0}, spring_damping{0.0}, free_position{0.0};  ///< torsion spring
  /// valid only if LimitDescription::bounds_position() or bounds_effort()
  T lower{0.0}, upper{0.0}, effort{0.0};
  StopConstants<T> stop;                  ///< valid if the study enforces the joint's limits
  T gear_ratio{1.0}, rotor_inertia{0.0};  ///< n and J_r of an actuator
  T armature{0.0};                        ///< JointDescription::armature
  /// unit vector in the axes of the body that carries the rotor
  Vector3<T> rotor_axis = Vector3<T>::Zero();
  GearConstants<T> gear;            ///< valid if the actuator has ActuatorDescription::gear
  ElasticGearConstants<T> elastic;  ///< likewise, ActuatorDescription::elastic
  WindingConstants<T> winding;      ///< likewise, ActuatorDescription::winding
};

/// One coordinate of a pair as a turn about, or a slide along, an axis; the coordinates of a pair
/// act one after the other.
template <class T>
struct JointStep {
  bool turns = false;
  Vector3<T> axis = Vector3<T>::Zero();  ///< unit vector in the axes of body i, at zero position
};

/// Geometry of a kinematic pair in body coordinates.
template <class T>
struct PairConstants {
  Vector3<T> s_i = Vector3<T>::Zero(), s_j = Vector3<T>::Zero();  ///< joint point on each body [m]
  /// Joint axes x'', y'', z'' on each body, as columns. They coincide at zero position, except for
  /// universal pairs.
  Matrix3<T> C_i = Matrix3<T>::Identity(), C_j = Matrix3<T>::Identity();
  T cosine{0.0};                  ///< kUniversal: z_i . z_j
  T distance{0.0};                ///< kDistance: the length [m]
  FrictionConstants<T> friction;  ///< valid if Pair::friction_joint is set
  SlipConstants<T> slip;          ///< isotropic friction; see slips_isotropically()
  /// one per chain element; a single cylindrical loop has two: turn, slide
  std::vector<CoordinateConstants<T>> coordinates;
  std::vector<JointDynamicsConstants<T>> dynamics;  ///< one per coordinate
  /// the motion of body j relative to body i; empty if it has no such coordinates
  std::vector<JointStep<T>> steps;
  /// axes of body j in those of body i, at zero position
  Matrix3<T> R_ij = Matrix3<T>::Identity();

  /// Sets everything to what a new object holds, but keeps the memory of the vectors.
  void clear() {
    PairConstants empty;
    empty.slip.coordinates.swap(slip.coordinates);
    empty.coordinates.swap(coordinates);
    empty.dynamics.swap(dynamics);
    empty.steps.swap(steps);
    *this = std::move(empty);
    slip.coordinates.clear();
    coordinates.clear();
    dynamics.clear();
    steps.clear();
  }
};

}  // namespace codesign
