// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "math/mesh_moments.h"
#include "reading/xml/xml_element.h"

namespace codesign {

/// The solid of a `<mesh>`, in the unit of its file: STL, binary or as text, and OBJ. The file is
/// found as MeshFinder::find() says.
/// @throws InputError, located at the mesh, for a file that is not there, that cannot be read or
/// has another format, and for a surface that is not closed.
MeshMoments read_mesh(const XmlElement& mesh);

/// The triangles of a file's content. @param is_obj whether it is OBJ, else STL. Empty: it is
/// neither.
std::vector<Triangle> triangles_in(const std::string& content, bool is_obj);

}  // namespace codesign
