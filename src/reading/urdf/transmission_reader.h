// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_READING_URDF_TRANSMISSION_READER_H_
#define MECHANISM_CODESIGN_READING_URDF_TRANSMISSION_READER_H_

#include "description/robot.h"
#include "reading/xml/xml_element.h"

namespace codesign {

/// Gives every `<codesign:actuator>` without gear_ratio the mechanical reduction of the ROS `<transmission>` of its joint. What a
/// transmission says that gives none is told as a warning; joints without an actuator are left alone.
/// @param element the `<robot>`, whose joints have been read.
void read_transmissions(const XmlElement& element, RobotDescription* robot);

}  // namespace codesign

#endif  // MECHANISM_CODESIGN_READING_URDF_TRANSMISSION_READER_H_
