// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "description/robot.h"

namespace codesign {

/// Checks that a joint of this kind has the dimensions that its normal forces, theory (12), are computed from: joint_length and joint_width
/// for prismatic joints; joint_length and pin_radius for revolute, continuous and cylindrical ones; pin_radius for spherical ones; none for
/// planar ones. The URDF reader calls this function for ordinary joints, derive_topology() for joints that it folds from a chain.
/// @throws InputError if a dimension is missing, if joints of this type have no friction law, or if a joint that slips in several
/// directions has numbers for motion against the axis.
void check_friction_geometry(const FrictionDescription& friction, PairKind kind, const std::string& element);

}  // namespace codesign
