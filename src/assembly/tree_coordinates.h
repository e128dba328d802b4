// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "equations/equations.h"
#include "system/tree_kinematics.h"

namespace codesign {

/// Coordinates and rates of the joints of the tree, TreeLayout::size entries each.
struct TreeCoordinates {
  VectorX<double> theta, rate;
};

/// The tree coordinates of a state, the inverse of body_coordinates(). The turns of a floating joint are about x, then y, then z.
/// @param equations must hold the design; they load `state`. @param rest coordinates of joints below which nothing has mass, kept.
/// @param result sized and filled. @returns the joint whose coordinate cannot be computed (a hinge of a folded chain without a closed form,
/// a floating joint turned by 90 degrees about y), or an empty text.
std::string tree_coordinates(const System& system, const TreeLayout& tree, const State<double>& state, const VectorX<double>& rest,
                             Equations<double>* equations, TreeCoordinates* result);

}  // namespace codesign
