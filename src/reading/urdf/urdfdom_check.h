// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_READING_URDF_URDFDOM_CHECK_H_
#define MECHANISM_CODESIGN_READING_URDF_URDFDOM_CHECK_H_

#include "reading/xml/xml_document.h"

namespace codesign {

/// Lets urdfdom, the parser of robot_state_publisher and rviz, read the document.
/// @throws InputError with urdfdom's own words if it refuses, at the element that they name, else at the root.
void check_with_urdfdom(const XmlDocument& document);

}  // namespace codesign

#endif  // MECHANISM_CODESIGN_READING_URDF_URDFDOM_CHECK_H_
