// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "mechanism_codesign/source_text.h"

namespace codesign {

/// An overlay to begin with, for a URDF as vendors write it: a comment for each thing that the file
/// does not say, and a line for it.
///
/// A line is an element where its numbers are known: `<dynamics armature>` of other tools as
/// `<codesign:actuator>`, and a floating joint to a new root where nothing else could move. It is
/// an element in a comment where a number has to be filled in: a floating base of a root with mass,
/// mass and inertia of links that have none, gear, rotor, friction of each joint. The numbers there
/// are of a usual size, so that the line can be read as it stands once the comment's marks are
/// taken away. doc/annotations.md lists them.
///
/// read_urdf() reads the URDF with these overlays and with the new one.
/// @param overlays what they give is not asked for again. @throws InputError as read_urdf().
std::string starting_overlay(const SourceText& urdf, const std::vector<SourceText>& overlays = {});

}  // namespace codesign
