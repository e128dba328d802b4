// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

namespace codesign {

/// Three corners, counterclockwise as seen from outside.
using Triangle = std::array<Eigen::Vector3d, 3>;

/// Integrals over the solid within a closed surface of triangles: the sums over tetrahedra from the
/// origin to each triangle (a, b, c), with d = a . (b x c), doc/theory.md (9d):
///   volume = sum d/6,  first = sum d/24 s,  second = sum d/120 (s s^T + a a^T + b b^T + c c^T),
/// s = a + b + c. Of a surface whose inside is outside, all signs are changed.
struct MeshMoments {
  double volume = 0.0;                               ///< int dV
  Eigen::Vector3d first = Eigen::Vector3d::Zero();   ///< int x dV
  Eigen::Matrix3d second = Eigen::Matrix3d::Zero();  ///< int x x^T dV
  /// The area of the holes over that of the surface: 0 of a closed one. Cracks between triangles
  /// whose corners do not meet have no area.
  double holes = 0.0;
};

MeshMoments moments_of(const std::vector<Triangle>& triangles);

}  // namespace codesign
