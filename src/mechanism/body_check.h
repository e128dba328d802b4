// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_MECHANISM_BODY_CHECK_H_
#define MECHANISM_CODESIGN_MECHANISM_BODY_CHECK_H_

#include <Eigen/Core>
#include <string>

#include "description/robot.h"
#include "mechanism/mass_properties.h"

namespace codesign {

/// What no solid body can have. `code` is empty if there is nothing.
struct MassFault {
  std::string code;     ///< negative_mass, inertia_not_positive, triangle_inequality
  std::string message;  ///< "the inertia breaks the triangle inequality"
  std::string value;
};

/// A negative mass, a negative principal moment, or one above the sum of the other two (relative 1e-6, as files are rounded).
/// No mass at all, points, rods and flat bodies are fine: whether their motion is determined is another question.
MassFault find_mass_fault(const MassProperties<double>& body);

/// Warns of such faults of each body at the default parameters: links joined by fixed joints are judged as one, and the root link, which is
/// the ground, is not judged.
/// @throws InputError for masses that cancel each other, since such a body has no centre.
void check_bodies(const RobotDescription& robot, Warnings* warnings);

}  // namespace codesign

#endif  // MECHANISM_CODESIGN_MECHANISM_BODY_CHECK_H_
