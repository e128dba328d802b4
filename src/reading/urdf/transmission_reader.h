// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "description/robot.h"
#include "reading/xml/xml_element.h"

namespace codesign {

/// Sets the gear ratio of every `<codesign:actuator>` without `gear_ratio` to the mechanical reduction in the ROS `<transmission>` of its
/// joint. A reduction that cannot be used is ignored with a warning: `transmission_not_read`, `transmission_contradicts` or
/// `transmission_not_simple`. Transmissions of joints without an actuator are not examined.
/// @param element the `<robot>`. @param robot its joints must have been read.
void read_transmissions(const XmlElement& element, RobotDescription* robot);

}  // namespace codesign
