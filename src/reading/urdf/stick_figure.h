// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace codesign {

/// A URDF for viewers: links without `<visual>`, or of whose visuals MeshFinder finds no mesh, get some, named `stick`, so that the
/// mechanism can be seen.
///
/// A link with mass gets a sphere at its joint, or a box if it slides there, and sticks from there to the frames of the joints and loops
/// below it; a link without joints below it gets a stick to its centre of mass and a sphere there. A massless link gets only sticks. The
/// sticks of the root connect the frames of its joints. Sticks are as thick as 4 % of the longest link.
/// @param urdf numbers at their values, as write_tuned_urdf() makes it. @returns the same text, to the letter, if each link has a visual or
/// nothing to draw, or if it is no XML.
std::string with_sticks(const std::string& urdf);

}  // namespace codesign
