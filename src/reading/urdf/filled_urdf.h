// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <string>
#include <vector>

#include "reading/urdf/urdf_reader.h"

namespace codesign {

/// write_filled_urdf() that tells where its lines come from. @param places of each line of the
/// result that begins an element, where this stands in the files.
std::string write_filled_urdf(const SourceText& urdf, const std::vector<SourceText>& overlays,
                              std::map<int, SourceLocation>* places);

}  // namespace codesign
