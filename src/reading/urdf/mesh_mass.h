// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>

#include "mechanism/mass_properties.h"
#include "reading/xml/xml_element.h"

namespace codesign {

/// Mass, centre and inertia about it, in the link frame, of the inside of the meshes of a link:
/// with d = a . (b x c) of each triangle,
///
///   V = sum d / 6,   V c = sum d (a + b + c) / 24,
///   C = sum d (a a^T + b b^T + c c^T + (a + b + c) (a + b + c)^T) / 120,
///
/// and the inertia about the origin is tr(C) I - C, times the density; F. Tonon, "Explicit exact
/// formulas for the 3-D tetrahedron inertia tensor in terms of its vertex coordinates", 2004. Where
/// meshes overlap, the common volume counts twice.
/// @param tag "visual" or "collision". @param folder of the URDF, for file names without a scheme.
/// @param density [kg/m^3]. @returns nothing if the link has no such shapes, if one is no STL file
/// on this machine, or if a surface is not closed.
std::optional<MassProperties<double>> mass_of_meshes(const XmlElement& link, const std::string& tag,
                                                     const std::string& folder, double density);

}  // namespace codesign
