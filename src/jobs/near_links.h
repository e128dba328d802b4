// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "mechanism_codesign/frame.h"
#include "mechanism_codesign/problem.h"
#include "reading/urdf/pictures.h"

namespace codesign {

/// Two links that no contact keeps apart although the boxes about their `<collision>` shapes are
/// near each other.
struct NearLinks {
  std::string first, second;
  double distance = 0.0;  ///< at least [m]; 0: the boxes overlap
};

/// A lower bound of the distance between two boxes, the largest gap along the normals of their
/// faces and edges [m]; 0 if they overlap. @param a, b with poses in the same axes.
double box_distance(const SolidBox& a, const SolidBox& b);

/// The pairs of links that a joint, loop or contact does not connect and that are nearer than a
/// tenth of the larger box of the smaller link. Links without mass, and of one body, are not
/// compared; meshes have no box.
/// @param frame a posture, with the poses of `links`.
std::vector<NearLinks> find_near_links(const Problem& problem,
                                       const std::vector<double>& parameters,
                                       const std::vector<std::string>& links, const Frame& frame);

}  // namespace codesign
