// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "description/robot.h"
#include "mechanism_codesign/source_text.h"

namespace codesign {

/// Warnings (`contact_not_read`) of keys by which other tools let links touch: `<gazebo>` with kp,
/// kd, mu1, SDF's `<surface>`, Bullet's `<contact>`, `drake:proximity_properties`, MuJoCo's solref
/// and solimp: one at most, which shows the contact to write of the first link and counts the
/// others. None of links that touch here already.
/// @param robot what read_urdf() makes of the texts. @throws InputError as read_urdf().
Warnings find_foreign_contacts(const SourceText& urdf, const std::vector<SourceText>& overlays,
                               const RobotDescription& robot);

}  // namespace codesign
