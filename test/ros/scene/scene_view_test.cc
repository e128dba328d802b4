// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "ros/scene/scene_view.h"

#include <gtest/gtest.h>

#include <cmath>

namespace codesign {
namespace {

/// Where rviz's camera draws a point: 1 at the right and at the upper edge of a picture kAspect
/// times as wide as high.
Eigen::Vector2d in_picture(const Eigen::Vector3d& point, const CameraPlace& camera,
                           const SceneView& view) {
  const Eigen::Vector3d eye = camera.focus + camera.distance * view.towards_viewer();
  const double depth = (eye - point).dot(view.towards_viewer()),
               half = std::tan(22.5 * 3.14159265358979323846 / 180.0);
  return {(point - eye).dot(view.right()) / (depth * half * kAspect),
          (point - eye).dot(view.up()) / (depth * half)};
}

TEST(SceneView, TheAxesOfThePictureAreARightHandedFrame) {
  const SceneView view{5.2, 0.45};
  EXPECT_NEAR(view.towards_viewer().z(), std::sin(0.45), 1e-12);
  EXPECT_TRUE(view.right().cross(view.up()).isApprox(view.towards_viewer(), 1e-12));
  EXPECT_GT(view.up().z(), 0.0);
  EXPECT_GT(view.right().x(), 0.0) << "x points to the right";
}

TEST(ViewOf, LooksAtTheBroadSide) {
  EXPECT_EQ(view_of({1.0, 0.1, 1.0}).yaw, 5.2);
  EXPECT_NE(view_of({0.1, 1.0, 1.0}).yaw, 5.2);
  EXPECT_GT(view_of({1.0, 1.0, 0.1}).pitch, view_of({1.0, 1.0, 1.0}).pitch);
  EXPECT_EQ(view_of({0.0, 0.0, 0.0}).pitch, 0.45);
}

TEST(PlaceCamera, AllPointsAreInThePictureAndFillIt) {
  for (const Eigen::Vector3d& sizes :
       {Eigen::Vector3d(1.0, 1.0, 1.0), Eigen::Vector3d(20.0, 1.0, 3.0),
        Eigen::Vector3d(1e-3, 1e-3, 4e-3), Eigen::Vector3d(4.0, 9.0, 0.1)}) {
    const SceneView view = view_of(sizes);
    const Eigen::Vector3d low(3.0, -5.0, 0.5);
    const std::vector<Eigen::Vector3d> points = corners({low, low + sizes});
    const CameraPlace camera = place_camera(points, view);
    double largest = 0.0;
    Eigen::AlignedBox2d picture;
    for (const Eigen::Vector3d& point : points) {
      picture.extend(in_picture(point, camera, view));
      largest = std::max(largest, in_picture(point, camera, view).cwiseAbs().maxCoeff());
    }
    EXPECT_LE(largest, 0.925) << sizes.transpose();
    EXPECT_GE(largest, 0.85) << sizes.transpose();
    EXPECT_NEAR(picture.center().norm(), 0.0, 0.05) << "in the middle: " << sizes.transpose();
  }
}

TEST(PlaceCamera, OfOnePointIsFinite) {
  EXPECT_GT(place_camera({{1.0, 2.0, 3.0}}, {}).distance, 0.0);
}

TEST(Corners, EightOfABoxNoneOfAnEmptyOne) {
  EXPECT_EQ(corners({Eigen::Vector3d::Zero(), Eigen::Vector3d::Ones()}).size(), 8U);
  EXPECT_TRUE(corners({}).empty());
}

TEST(RoundDown, ToOneTwoOrFive) {
  EXPECT_DOUBLE_EQ(round_down(0.9), 0.5);
  EXPECT_DOUBLE_EQ(round_down(4.9), 2.0);
  EXPECT_DOUBLE_EQ(round_down(0.0199), 0.01);
  EXPECT_DOUBLE_EQ(round_down(1.0), 1.0);
  EXPECT_DOUBLE_EQ(round_down(50.0), 50.0);
}

}  // namespace
}  // namespace codesign
