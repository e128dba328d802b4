// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <tinyxml2.h>

#include <Eigen/Geometry>

namespace codesign {

// Lenient reading of plain URDF, for pictures: a missing attribute, or one that is not a number, is zero.

/// One number of an attribute.
double plain_number(const tinyxml2::XMLElement* element, const char* attribute);

/// Three numbers of an attribute. @param element may be null.
Eigen::Vector3d plain_vector(const tinyxml2::XMLElement* element, const char* attribute);

/// The child `<origin>` of an element, or the element itself if it has `xyz` or `rpy`: angles in radians about fixed axes x, y, z.
Eigen::Isometry3d plain_origin(const tinyxml2::XMLElement* element);

}  // namespace codesign
