// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "description/robot.h"
#include "reading/xml/xml_document.h"

namespace codesign {

/// Parses the URDF, merges the overlays and checks all element and attribute names. @throws InputError
XmlDocument load_annotated_urdf(const SourceText& urdf, const std::vector<SourceText>& overlays, const Laws& laws = standard_laws());

/// The mechanism that the document describes, with the warnings of the document and of reading it. @throws InputError
RobotDescription read_robot(const XmlDocument& document, const Laws& laws = standard_laws());

}  // namespace codesign
