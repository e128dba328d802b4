// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "description/robot.h"
#include "mechanism_codesign/source_text.h"

namespace codesign {

/// The name of the overlay that with_floating_base() adds.
inline constexpr const char* kFloatingBase = "base: floating";
/// The joint on which the model's root link then hangs; a study gives its start.
inline constexpr const char* kFloatingBaseJoint = "floating_base";

/// The overlays with one more, by which the model's root link hangs on a floating joint,
/// kFloatingBaseJoint, from a new root link `world`: the mechanism moves freely in space. They are
/// returned as they are if the root link already has such a joint.
/// @param robot as model and overlays describe it.
/// @throws InputError if no link of the base has mass, or if the names are taken.
std::vector<SourceText> with_floating_base(const RobotDescription& robot,
                                           std::vector<SourceText> overlays);

}  // namespace codesign
