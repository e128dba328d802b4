// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "description/robot.h"

namespace codesign {

/// The mass [kg] of the root link and of all links that are fixed to it, at the default parameters:
/// the ground holds it, so that it has no effect.
double mass_of_base(const RobotDescription& robot);

/// Whether the file says itself that its base stands: a root link without mass that is named after
/// the ground (world, ground, map, odom).
bool is_on_ground(const RobotDescription& robot);

}  // namespace codesign
