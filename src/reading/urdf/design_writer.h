// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "description/robot.h"
#include "reading/xml/xml_document.h"

namespace codesign {

/// Gives the parameters of a document other defaults. Every attribute with a twin and every inertial computed from shapes follows. A bound
/// that a value exceeds is moved to the value, so that the document stays valid.
/// @param robot as read_robot() reads the document. @param values of its parameters, in their order. @throws InputError if a value, or the
/// value of a twin, is not finite
void write_design(const RobotDescription& robot, const std::vector<double>& values, XmlDocument* document);

}  // namespace codesign
