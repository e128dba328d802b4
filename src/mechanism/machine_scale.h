// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "description/motion_study.h"
#include "description/robot.h"
#include "math/scalar.h"
#include "mechanism/mass_properties.h"

namespace codesign {

/// The masses on a link or joint: mass, first moment and inertia about the origin of its frame.
template <class T>
struct CarriedMass {
  T mass{0.0};                             ///< [kg]
  Vector3<T> moment = Vector3<T>::Zero();  ///< sum of m r [kg m]
  Matrix3<T> J = Matrix3<T>::Zero();       ///< sum of m (r.r I - r r^T) [kg m^2]
};

/// What hangs on a joint with all joints at zero, doc/theory.md (13i): the links below it; of a
/// loop what hangs on its successor, or on its predecessor if the successor is the root.
template <class T>
struct JointScale {
  T mass{0.0};  ///< m [kg]; of the whole machine if nothing with mass hangs on the joint
  /// M along the coordinate, without rotors: m of a slide [kg], else about the axis [kg m^2]; zero
  /// for joints without a coordinate of their own
  T inertia{0.0};
};

/// The scales of a machine at one design.
template <class T>
struct MachineScale {
  /// of RobotDescription::joints; behind an elastic gear that of the motor is that of its joint
  std::vector<JointScale<T>> joints;
  JointScale<T> all;  ///< the whole machine, M about the root's origin
  /// a [m/s^2]: gravity; without it the radius of gyration of the machine about the root's origin
  /// over T^2
  T acceleration{0.0};

  std::vector<CarriedMass<T>> carried;    ///< workspace: per link
  std::vector<std::size_t> from_leaves;   ///< workspace: joints of the tree, the last ones first
  std::vector<MassProperties<T>> shapes;  ///< workspace
};

/// The duration T of a study as a scale [s]; 1 s of a study without time.
double time_scale(const MotionStudy& study);

/// Evaluates the scales. @param parameters all named ones. @param scale its memory is used again,
/// so that later designs of the same robot allocate nothing.
template <class T>
void set_machine_scale(const RobotDescription& robot, const MotionStudy& study,
                       const std::vector<T>& parameters, MachineScale<T>* scale);

}  // namespace codesign
