// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "description/robot.h"
#include "reading/urdf/twin.h"

namespace codesign {

/// A link's `<inertial>`; std::nullopt if there is none, or if mass and inertia are all zero, as some exporters write massless links.
/// Whether a body can have these numbers is checked later, when it is known which links form a body (check_bodies()).
/// @throws InputError for missing or malformed values, and for plain values that disagree with the shapes.
std::optional<InertialDescription> read_inertial(const XmlElement& link, const ParameterTable& table);

}  // namespace codesign
