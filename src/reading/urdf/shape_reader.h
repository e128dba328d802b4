// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "description/robot.h"
#include "reading/urdf/twin.h"

namespace codesign {

/// The solids of a link's `<visual>` or `<collision>` elements.
/// @param tag "visual" or "collision". @throws InputError if there are none, or if one is a mesh, whose volume is not computed.
std::vector<ShapeDescription> read_solids(const XmlElement& link, const std::string& tag, const ParameterTable& table);

}  // namespace codesign
