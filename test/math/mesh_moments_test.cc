// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "math/mesh_moments.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

namespace codesign {
namespace {

using Vector = Eigen::Vector3d;

/// A box from `from` to `to`, twelve triangles.
std::vector<Triangle> box(const Vector& from, const Vector& to) {
  std::vector<Triangle> triangles;
  const auto corner = [&](int k) {
    return Vector(k & 1 ? to[0] : from[0], k & 2 ? to[1] : from[1], k & 4 ? to[2] : from[2]);
  };
  const int faces[6][4] = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4},
                           {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
  for (const auto& face : faces) {
    triangles.push_back({corner(face[0]), corner(face[1]), corner(face[2])});
    triangles.push_back({corner(face[0]), corner(face[2]), corner(face[3])});
  }
  return triangles;
}

TEST(MeshMoments, OfABoxAnywhere) {
  const Vector from(1.0, -2.0, 3.0), to(1.5, -1.0, 5.0), centre = 0.5 * (from + to);
  const MeshMoments moments = moments_of(box(from, to));
  const double volume = 0.5 * 1.0 * 2.0;
  EXPECT_NEAR(moments.volume, volume, 1e-13);
  EXPECT_LT((moments.first - volume * centre).norm(), 1e-12);
  const Vector sides = to - from;
  const Eigen::Matrix3d about_centre = moments.second - volume * centre * centre.transpose(),
                        exact =
                            volume / 12.0 * Eigen::Matrix3d(sides.cwiseProduct(sides).asDiagonal());
  EXPECT_LT((about_centre - exact).norm(), 1e-11);
  EXPECT_EQ(moments.holes, 0.0);
}

TEST(MeshMoments, OfATetrahedronByItsIntegrals) {
  const Vector a(1.0, 0.0, 0.0), b(0.0, 1.0, 0.0), c(0.0, 0.0, 1.0), o(0.0, 0.0, 0.0);
  const MeshMoments moments = moments_of({{o, b, a}, {o, a, c}, {o, c, b}, {a, b, c}});
  EXPECT_NEAR(moments.volume, 1.0 / 6.0, 1e-15);
  EXPECT_NEAR(moments.first[1], 1.0 / 24.0, 1e-16);
  EXPECT_NEAR(moments.second(0, 0), 1.0 / 60.0, 1e-16);
  EXPECT_NEAR(moments.second(0, 1), 1.0 / 120.0, 1e-16);
}

TEST(MeshMoments, OfASurfaceWithTheInsideOut) {
  std::vector<Triangle> triangles = box(Vector::Zero(), Vector::Ones());
  for (Triangle& one : triangles) std::swap(one[0], one[1]);
  const MeshMoments moments = moments_of(triangles);
  EXPECT_NEAR(moments.volume, 1.0, 1e-14);
  EXPECT_NEAR(moments.first[2], 0.5, 1e-14);
}

TEST(MeshMoments, KnowTheirHoles) {
  std::vector<Triangle> open = box(Vector(-1.0, -1.0, -1.0), Vector(1.0, 1.0, 1.0));
  open.erase(open.begin(), open.begin() + 2);
  EXPECT_NEAR(moments_of(open).holes, 4.0 / 20.0, 1e-12);
  // Two opposite holes, whose areas as vectors cancel.
  open.erase(open.begin(), open.begin() + 2);
  EXPECT_NEAR(moments_of(open).holes, 8.0 / 16.0, 1e-12);
}

TEST(MeshMoments, CracksWithoutAreaAreNoHoles) {
  // One triangle of a face is split at a corner that its neighbour does not have.
  std::vector<Triangle> triangles = box(Vector::Zero(), Vector::Ones());
  const auto [a, b, c] = triangles[0];
  const Vector middle = 0.5 * (a + b);
  triangles[0] = {a, middle, c};
  triangles.push_back({middle, b, c});
  EXPECT_NEAR(moments_of(triangles).holes, 0.0, 1e-15);
  EXPECT_NEAR(moments_of(triangles).volume, 1.0, 1e-14);
}

}  // namespace
}  // namespace codesign
