// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "ros/scene_layout.h"

#include <gtest/gtest.h>

#include <cmath>

#include "ros/sample_frame.h"

namespace codesign {
namespace {

std::vector<Frame> sample_run(double force) {
  std::vector<Frame> run{sample_frame(0.0), sample_frame(0.1)};
  run[1].frictions[0].force = {0.0, force, 0.0};
  return run;
}

SceneLayout lay_out_both(const std::vector<Frame>& first, const std::vector<Frame>& second, const LinkBoxes& boxes = LinkBoxes(3)) {
  static const FrameNames kNames = sample_names();
  const auto solids = std::make_shared<LinkBoxes>(boxes);
  return lay_out({{kNames, first, solids}, {kNames, second, solids}});
}

TEST(LayOut, TheExtentIsThatOfLinksAndTheirSolids) {
  // The sample's links span 1 m along x and 2 m along y.
  EXPECT_DOUBLE_EQ(lay_out_both(sample_run(1.0), sample_run(1.0)).size, 2.0);
  LinkBoxes boxes(3);
  boxes[2].push_back({Eigen::Isometry3d::Identity(), {0.1, 0.3, 4.0}});
  const SceneLayout tall = lay_out_both(sample_run(1.0), sample_run(1.0), boxes);
  EXPECT_DOUBLE_EQ(tall.size, 8.0);
  EXPECT_DOUBLE_EQ(tall.floor, -4.0);
}

TEST(LayOut, AFloorCountsAsFarAsHalfASizeAroundWhatMoves) {
  LinkBoxes boxes(3);
  boxes[0].push_back({Eigen::Isometry3d::Identity(), {100.0, 100.0, 0.25}});
  const SceneLayout layout = lay_out_both(sample_run(1.0), sample_run(1.0), boxes);
  EXPECT_DOUBLE_EQ(layout.size, 2.0 + 2.0 * 0.5 * 2.0);
  EXPECT_DOUBLE_EQ(layout.floor, -0.25);
}

TEST(LayOut, ATypicalArrowIsAFifthOfTheMechanismInTwoDigits) {
  // Forces of 4, 3, 4 and 5 N, whose mean square is 16.5; torques of 2 N m throughout.
  const SceneLayout layout = lay_out_both(sample_run(3.0), sample_run(5.0));
  EXPECT_DOUBLE_EQ(layout.style.metres_per_newton, 0.098) << "0.4 m over 4.06 N";
  EXPECT_DOUBLE_EQ(layout.style.metres_per_newton_metre, 0.2);
  EXPECT_TRUE(layout.has_forces);
  EXPECT_TRUE(layout.has_torques);
}

TEST(LayOut, TheArrowOfAPeakIsHalfAsLongAsTheMechanism) {
  std::vector<Frame> peaked = sample_run(1e3);
  peaked.resize(100, sample_frame(0.0));
  EXPECT_DOUBLE_EQ(lay_out_both(sample_run(3.0), peaked).style.metres_per_newton * 1e3, 1.0);
}

TEST(LayOut, ArrowsAreInTheBox) {
  const SceneLayout layout = lay_out_both(sample_run(3.0), sample_run(-5.0));
  EXPECT_LE(layout.box.min().y(), 0.2 - 5.0 * layout.style.metres_per_newton + 1e-12);
  EXPECT_LE(layout.box.min().z(), 0.6 - 2.0 * layout.style.metres_per_newton_metre);
}

TEST(LayOut, WithoutFramesItStaysFinite) {
  const FrameNames names = sample_names();
  const std::vector<Frame> none;
  for (const SceneLayout& layout : {lay_out({}), lay_out({{names, none, nullptr}})}) {
    EXPECT_GT(layout.style.shaft_diameter, 0.0);
    EXPECT_GT(layout.letter, 0.0);
    EXPECT_TRUE(std::isfinite(layout.style.metres_per_newton));
    EXPECT_TRUE(std::isfinite(stage_of(layout, {Eigen::Vector3d::Zero()}, 3).scene.distance));
  }
}

TEST(LayOut, AFrameThatIsNotFiniteDoesNotCount) {
  std::vector<Frame> broken = sample_run(1.0);
  broken[1].links[1].position.setConstant(std::nan(""));
  broken[1].frictions[0].force.setConstant(std::nan(""));
  EXPECT_DOUBLE_EQ(lay_out_both(sample_run(1.0), broken).size, 2.0);
}

/// Where a point lies in the picture, seen from far [m].
Eigen::Vector2d seen(const SceneLayout& layout, const Eigen::Vector3d& point) {
  return {point.dot(layout.view.right()), point.dot(layout.view.up())};
}

TEST(LayOut, ThePicturesOfBothMechanismsDoNotOverlap) {
  const SceneLayout layout = lay_out_both(sample_run(3.0), sample_run(5.0));
  Eigen::AlignedBox2d one, other;
  for (const Eigen::Vector3d& corner : corners(layout.box)) {
    one.extend(seen(layout, corner));
    other.extend(seen(layout, corner + layout.apart));
  }
  EXPECT_FALSE(one.intersects(other));
  EXPECT_EQ(layout.apart.z(), 0.0) << "both stand on the ground";
}

TEST(StageOf, HoldsMechanismsArrowsAndTextAboveThem) {
  const SceneLayout layout = lay_out_both(sample_run(3.0), sample_run(5.0));
  const Stage alone = stage_of(layout, {Eigen::Vector3d::Zero()}, 3), both = stage_of(layout, {-0.5 * layout.apart, 0.5 * layout.apart}, 3);
  EXPECT_GT(both.scene.distance, alone.scene.distance);
  for (std::size_t k = 0; k < 3; ++k) {
    const auto i = static_cast<Eigen::Index>(k);
    EXPECT_LE(alone.scene.smallest[k], layout.box.min()[i]);
    EXPECT_GE(alone.scene.largest[k], layout.box.max()[i]);
  }
  for (const Eigen::Vector3d& corner : corners(layout.box))
    EXPECT_LT(seen(layout, corner).y(), seen(layout, alone.caption).y() - 2.0 * 1.6 * layout.letter) << "below the third line";
  EXPECT_EQ(alone.scene.grid_cell, 0.2);
  EXPECT_EQ(alone.scene.metres_per_newton, layout.style.metres_per_newton);
  EXPECT_EQ(alone.scene.yaw, layout.view.yaw);
}

}  // namespace
}  // namespace codesign
