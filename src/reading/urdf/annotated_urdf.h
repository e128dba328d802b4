// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_READING_URDF_ANNOTATED_URDF_H_
#define MECHANISM_CODESIGN_READING_URDF_ANNOTATED_URDF_H_

#include <vector>

#include "description/robot.h"
#include "reading/xml/xml_document.h"

namespace codesign {

/// The URDF with its overlays merged in and its annotations known to be ours. @throws InputError
XmlDocument load_annotated_urdf(const SourceText& urdf, const std::vector<SourceText>& overlays);

/// @throws InputError
RobotDescription read_robot(const XmlDocument& document);

}  // namespace codesign

#endif  // MECHANISM_CODESIGN_READING_URDF_ANNOTATED_URDF_H_
