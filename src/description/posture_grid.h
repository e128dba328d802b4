// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "mechanism_codesign/error.h"

namespace codesign {

/// The positions of one joint in a grid of postures [rad or m]; at least one.
struct GridJoint {
  std::string joint;
  std::vector<double> positions;
  SourceLocation where;
};

/// Postures: every combination of the joints' positions, the last joint changing fastest.
using PostureGrid = std::vector<GridJoint>;

/// The number of postures; 0 for an empty grid.
inline std::size_t count_postures(const PostureGrid& grid) {
  std::size_t count = grid.empty() ? 0 : 1;
  for (const GridJoint& joint : grid) count *= joint.positions.size();
  return count;
}

}  // namespace codesign
