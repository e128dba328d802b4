// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "reading/xml/xml_document.h"

namespace codesign {

/// Checks that urdfdom, the parser of robot_state_publisher and rviz, accepts the document.
/// @throws InputError with urdfdom's message, located at the element that it names, else at the root.
void check_with_urdfdom(const XmlDocument& document);

}  // namespace codesign
