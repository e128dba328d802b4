// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_MECHANISM_CONSTANTS_H_
#define MECHANISM_CODESIGN_MECHANISM_CONSTANTS_H_

#include <array>
#include <string>
#include <vector>

#include "description/robot.h"
#include "math/scalar.h"
#include "mechanism/topology.h"

namespace codesign {

/// Mass properties of a body, and where its base link lies. The body frame has the base link's axes and its origin at the centre of mass.
template <class T>
struct BodyConstants {
  T mass{0.0};                             ///< [kg]
  Matrix3<T> J = Matrix3<T>::Zero();       ///< about the centre of mass, in body axes [kg m^2]
  Vector3<T> centre = Vector3<T>::Zero();  ///< of mass, in the base link [m]
};

/// How one URDF joint of a pair is read off the bodies' coordinates.
template <class T>
struct CoordinateConstants {
  enum class Kind {
    kNone,   ///< not available (a joint without a scalar position, or a chain that has no closed form)
    kTurn,   ///< about the common z axis: sign atan2(y_i . x_j, x_i . x_j)
    kSlide,  ///< sign a . d with a fixed in `side`
    kAngle,  ///< sign atan2(a_i . b_j, c_i . d_j)
    kSine,   ///< sign asin(a_i . b_j)
    kSpin    ///< a rate only: a . (omega_j - omega_i), a fixed in the ground
  };
  Kind kind = Kind::kNone;
  double sign = 1.0;
  bool fixed_in_j = false;  ///< kSlide: a is carried by j
  Vector3<T> a = Vector3<T>::Zero(), b = Vector3<T>::Zero(), c = Vector3<T>::Zero(), d = Vector3<T>::Zero();
};

/// How a contact may slip in several directions at once: its components, and the arm that makes a slip velocity of each rate; theory (13a).
template <class T>
struct SlipConstants {
  std::vector<CoordinateConstants<T>> coordinates;   ///< empty, two (table) or three (planar, spherical)
  std::array<T, 3> arm{T(1.0), T(1.0), T(1.0)};      ///< 1 for a slide, r_e [m] for a turn
  std::array<T, 3> viscous{T(0.0), T(0.0), T(0.0)};  ///< load per rate
};

/// Friction coefficients and joint geometry; SI units, see FrictionDescription.
template <class T>
struct FrictionConstants {
  T mu_static{0.0}, mu_dynamic{0.0}, transition_velocity{1.0}, joint_length{1.0}, joint_width{1.0}, pin_radius{0.0}, friction_arm{0.0},
      preload{0.0}, smoothing{1.0}, viscous{0.0}, bristle_stiffness{1.0}, bristle_damping{1.0}, dwell_time{1.0};
};

/// URDF's `<dynamics>` and `<limit>`, and our torsion spring on one joint.
template <class T>
struct JointDynamicsConstants {
  T damping{0.0}, dry_friction{0.0}, stiffness{0.0}, spring_damping{0.0}, free_position{0.0};
  T lower{0.0}, upper{0.0}, effort{0.0};       ///< meaningless where LimitDescription says that they bound nothing
  T gear_ratio{1.0}, rotor_inertia{0.0};       ///< n and J_r of an actuator
  Vector3<T> rotor_axis = Vector3<T>::Zero();  ///< in the axes of the body that carries the rotor, see Rotor
};

/// Geometry of a kinematic pair in body coordinates.
template <class T>
struct PairConstants {
  Vector3<T> s_i = Vector3<T>::Zero(), s_j = Vector3<T>::Zero();  ///< joint point on each body [m]
  Matrix3<T> C_i = Matrix3<T>::Identity(),
             C_j = Matrix3<T>::Identity();  ///< joint axes x'', y'', z'' on each body, aligned at zero position
  T cosine{0.0};                            ///< universal: z_i . z_j
  T distance{0.0};                          ///< kDistance [m]
  FrictionConstants<T> friction;
  SlipConstants<T> slip;                            ///< of isotropic friction
  std::vector<CoordinateConstants<T>> coordinates;  ///< per chain element; of one cylindrical loop: turn, slide
  std::vector<JointDynamicsConstants<T>> dynamics;  ///< as `coordinates`
};

/// Where a link frame lies in its body (or in the ground).
template <class T>
struct LinkConstants {
  Vector3<T> s = Vector3<T>::Zero();
  Matrix3<T> R = Matrix3<T>::Identity();
};

template <class T>
struct SpringDamperConstants {
  int body_i = -1, body_j = -1;
  Vector3<T> s_i = Vector3<T>::Zero(), s_j = Vector3<T>::Zero();
  T stiffness{0.0}, damping{0.0}, free_length{0.0};
};

/// A row sum of coefficients_k theta_k = offset; terms as in Coupling.
template <class T>
struct CouplingConstants {
  std::vector<T> coefficients;
  T offset{0.0};
};

/// Every number of a mechanism at one design rho.
template <class T>
struct Constants {
  std::vector<BodyConstants<T>> bodies;
  std::vector<PairConstants<T>> pairs;
  std::vector<LinkConstants<T>> links;         ///< of links that belong to a body or the ground
  std::vector<LinkConstants<T>> joint_frames;  ///< per joint: its frame as the child (of a loop: the successor) carries it, likewise
  std::vector<SpringDamperConstants<T>> springs;
  std::vector<CouplingConstants<T>> couplings;
};

/// Evaluates the description at `parameters` (all named parameters). T: double, std::complex<double>, Lanes<N>.
template <class T>
Constants<T> evaluate_constants(const RobotDescription& robot, const Topology& topology, const std::vector<T>& parameters);

/// Empty if every mass, inertia, length and coefficient of the design can be; else a sentence that names the first that cannot.
std::string find_impossible(const RobotDescription& robot, const Topology& topology, const Constants<double>& constants);

}  // namespace codesign

#endif  // MECHANISM_CODESIGN_MECHANISM_CONSTANTS_H_
