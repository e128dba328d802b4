// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <string>

#include "description/robot.h"
#include "mechanism/mass_properties.h"

namespace codesign {

/// Mass properties that no solid body can have.
struct MassFault {
  std::string code;     ///< negative_mass, inertia_not_positive, triangle_inequality, or empty if there is no fault
  std::string message;  ///< for example "the inertia breaks the triangle inequality"
  std::string value;    ///< the offending numbers
};

/// Finds a negative mass, a negative principal moment of inertia, or a principal moment above the sum of the other two. The tolerances,
/// 1e-9 and 1e-6 relative, allow for rounded files. Bodies without mass, points, rods and flat bodies have no fault; whether the equations
/// determine their motion is checked elsewhere, theory (14a).
MassFault find_mass_fault(const MassProperties<double>& body);

/// Warns of mass faults at the default parameters. Links joined by fixed joints count as one body; the root link, which is the ground, is
/// not checked.
/// @throws InputError if the masses of a body's links add up to zero, since it then has no centre of mass.
void check_bodies(const RobotDescription& robot, Warnings* warnings);

}  // namespace codesign
