// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <string>
#include <vector>

namespace codesign {

/// The box around a visual solid.
struct SolidBox {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();  ///< axes of the box, with the origin in its centre, in the frame of its link
  Eigen::Vector3d half = Eigen::Vector3d::Zero();          ///< half of its sides [m]
};

/// The boxes of the solids of each link.
using LinkBoxes = std::vector<std::vector<SolidBox>>;

/// The boxes around the `<visual>` elements of a URDF whose numbers are at their values, as write_tuned_urdf() makes it.
/// @param links names; the result has one entry for each, in their order. A link without visuals has no boxes, nor has a mesh, whose size
/// is not known. @returns entries without boxes if the text cannot be read: this serves pictures only.
LinkBoxes link_boxes(const std::string& urdf, const std::vector<std::string>& links);

}  // namespace codesign
