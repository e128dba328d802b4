// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "forces/contact_shape.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

namespace codesign {
namespace {

using V = Vector3<double>;

const ContactShape& shape_of(const std::string& name) {
  static const std::vector<ShapeKind> shapes = contact_shapes();
  for (const ShapeKind& shape : shapes)
    if (shape->name == name) return *shape;
  throw std::out_of_range(name);
}

const ShapeNumbers<double> kNumbers{0.3, 0.8, V(0.4, 0.6, 1.0)};

double distance(const std::string& name, const V& at) {
  return shape_of(name).surface.computed(at, kNumbers).distance;
}

TEST(ContactShape, DistancesByHand) {
  EXPECT_EQ(distance("plane", V(3.0, -2.0, 0.25)), 0.25);
  EXPECT_NEAR(distance("sphere", V(0.3, 0.4, 0.0)), 0.2, 1e-15);
  EXPECT_NEAR(distance("sphere", V(0.0, 0.1, 0.0)), -0.2, 1e-15);
  EXPECT_NEAR(distance("socket", V(0.0, 0.1, 0.0)), 0.2, 1e-15);
  EXPECT_NEAR(distance("bore", V(0.06, 0.08, 7.0)), 0.2, 1e-15);
  EXPECT_NEAR(distance("slot", V(3.0, -2.0, 0.25)), 0.15, 1e-15);
  EXPECT_NEAR(distance("slot", V(3.0, -2.0, -0.5)), -0.1, 1e-15);
  EXPECT_NEAR(distance("capsule", V(0.5, 0.0, 0.39)), 0.2, 1e-15) << "beside it";
  EXPECT_NEAR(distance("capsule", V(0.3, 0.0, -0.8)), 0.2, 1e-15) << "beyond its end";
  EXPECT_NEAR(distance("box", V(0.25, 0.1, 0.2)), 0.05, 1e-15) << "a face";
  EXPECT_NEAR(distance("box", V(0.23, -0.34, 0.2)), 0.05, 1e-15) << "an edge";
  EXPECT_NEAR(distance("box", V(-0.22, 0.31, 0.52)), 0.03, 1e-15) << "a corner";
  EXPECT_NEAR(distance("box", V(0.1, -0.25, 0.2)), -0.05, 1e-15) << "inside";
  EXPECT_NEAR(distance("cylinder", V(0.3, 0.4, 0.1)), 0.2, 1e-15) << "its side";
  EXPECT_NEAR(distance("cylinder", V(0.1, 0.0, -0.5)), 0.1, 1e-15) << "its end";
  EXPECT_NEAR(distance("cylinder", V(0.33, 0.0, 0.44)), 0.05, 1e-15) << "its edge";
  EXPECT_NEAR(distance("cylinder", V(0.1, 0.0, 0.35)), -0.05, 1e-15) << "inside";
}

TEST(ContactShape, NormalIsTheGradientOfTheDistance) {
  int tried = 0;
  for (const ShapeKind& shape : contact_shapes()) {
    if (!shape->surface) continue;
    for (const V& at : {V(0.5, 0.4, 0.3), V(-0.31, 0.2, 0.77), V(0.1, -0.25, 0.2),
                        V(0.26, 0.05, -0.55), V(-0.05, 0.02, 0.47)}) {
      const V normal = shape->surface.computed(at, kNumbers).normal;
      EXPECT_NEAR(normal.norm(), 1.0, 1e-14) << shape->name;
      constexpr double kStep = 1e-5;
      for (int axis = 0; axis < 3; ++axis) {
        const V step = kStep * V::Unit(axis);
        EXPECT_NEAR(
            normal[axis],
            (distance(shape->name, at + step) - distance(shape->name, at - step)) / (2.0 * kStep),
            1e-8)
            << shape->name << ' ' << at.transpose();
      }
      ++tried;
    }
  }
  EXPECT_EQ(tried, 8 * 5);
}

TEST(ContactShape, CentresOfHollowsAreFinite) {
  for (const char* name : {"socket", "bore"}) {
    const SurfaceDistance<double> to = shape_of(name).surface.computed(V::Zero(), kNumbers);
    EXPECT_NEAR(to.distance, 0.3, 1e-11) << name;
    EXPECT_EQ(to.normal.norm(), 0.0) << name;
  }
}

TEST(ContactShape, Points) {
  const V down(0.6, 0.0, -0.8);
  EXPECT_EQ(shape_of("sphere").point.computed(0, down, kNumbers).norm(), 0.0);
  EXPECT_EQ(shape_of("capsule").point.computed(0, down, kNumbers)[2], -0.4);
  EXPECT_EQ(shape_of("capsule").point.computed(1, down, kNumbers)[2], 0.4);
  V sum = V::Zero();
  double lowest = 0.0;
  for (int k = 0; k < 8; ++k) {
    const V corner = shape_of("box").point.computed(k, down, kNumbers);
    EXPECT_EQ(corner.cwiseAbs(), V(0.2, 0.3, 0.5));
    sum += corner;
    lowest = std::max(lowest, corner.dot(down));
  }
  EXPECT_EQ(sum.norm(), 0.0) << "all eight";
  EXPECT_NEAR(lowest, 0.6 * 0.2 + 0.8 * 0.5, 1e-15);
  // A disc that leans: the rim's point in the direction of what of it lies in the disc.
  EXPECT_LT((shape_of("disc").point.computed(0, down, kNumbers) - V(0.3, 0.0, 0.0)).norm(), 1e-12);
  EXPECT_EQ(shape_of("disc").point.computed(0, V(0.0, 0.0, -1.0), kNumbers).norm(), 0.0);
}

TEST(ContactShape, TheTableSaysWhatTouchesWhat) {
  const auto takes = [](const char* surface, const char* points) {
    return shape_of(surface).takes(shape_of(points));
  };
  for (const char* surface :
       {"plane", "sphere", "socket", "bore", "slot", "capsule", "box", "cylinder"})
    EXPECT_TRUE(takes(surface, "sphere")) << surface;
  for (const char* points : {"capsule", "box"}) {
    for (const char* surface : {"plane", "socket", "bore", "slot"})
      EXPECT_TRUE(takes(surface, points));
    for (const char* surface : {"sphere", "box", "capsule", "cylinder", "disc"})
      EXPECT_FALSE(takes(surface, points)) << surface << points;
  }
  EXPECT_TRUE(takes("plane", "disc"));
  EXPECT_FALSE(takes("socket", "disc"));
  EXPECT_FALSE(takes("plane", "plane"));
  EXPECT_FALSE(takes("disc", "sphere"));
}

TEST(ContactShape, Extents) {
  EXPECT_EQ(extent_of(shape_of("box"), kNumbers), 0.2);
  EXPECT_EQ(extent_of(shape_of("capsule"), kNumbers), 0.3);
  EXPECT_EQ(extent_of(shape_of("plane"), kNumbers), std::numeric_limits<double>::infinity());
}

}  // namespace
}  // namespace codesign
