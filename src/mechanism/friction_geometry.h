// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_MECHANISM_FRICTION_GEOMETRY_H_
#define MECHANISM_CODESIGN_MECHANISM_FRICTION_GEOMETRY_H_

#include <string>

#include "description/robot.h"

namespace codesign {

/// Checks that a joint of `type` has the dimensions its normal forces are computed from: prismatic joints a joint_length and a joint_width,
/// revolute, continuous and cylindrical ones a joint_length and a pin_radius, spherical ones a pin_radius, planar ones none.
/// The reader calls it for ordinary joints; of a joint folded from a chain the type is known only to who folds it.
/// @throws InputError if one is missing, or joints of this type have no friction law.
void check_friction_geometry(const FrictionDescription& friction, JointType type, const std::string& element);

}  // namespace codesign

#endif  // MECHANISM_CODESIGN_MECHANISM_FRICTION_GEOMETRY_H_
