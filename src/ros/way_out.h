// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mechanism_codesign/frame.h"
#include "reading/urdf/pictures.h"

namespace codesign {

/// The distance from a point to the outside of all solids along a ray [m]: the smallest s >= 0 such that the next `clearance` metres beyond
/// `from` + s * `along` lie in no box. Boxes that touch, or are nearer to each other than `clearance`, are left together.
/// @param along a unit vector, in world axes like `from`. @param boxes in the order of the frame's links.
double way_out(const Eigen::Vector3d& from, const Eigen::Vector3d& along, const Frame& frame, const LinkBoxes& boxes, double clearance);

}  // namespace codesign
