// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "assembly/stuck_joints.h"

#include <gtest/gtest.h>

#include <cmath>

#include "assembly/loops_to_close.h"

namespace codesign {
namespace {

/// A block on a slope of 0.25 rad, on bristles that hold it up to `coulomb` [N].
std::string block(const std::string& coulomb) {
  return robot(
      "<link name='box'><inertial><mass value='2'/><inertia ixx='0.01' ixy='0' ixz='0' iyy='0.01' "
      "iyz='0' izz='0.02'/></inertial></link><joint name='slide' type='prismatic'><parent "
      "link='ground'/><child link='box'/><origin rpy='0 0.25 0'/><axis xyz='1 0 0'/><limit "
      "lower='-9' upper='9' effort='9' velocity='9'/><codesign:friction model='lugre' coulomb='" +
      coulomb + "'/></joint>");
}

/// Its state at rest.
struct StuckBlock {
  LoopsToClose c;
  StuckJoints stuck;
  RateSolution rates;
  State<double> state;
  Warnings warnings;

  explicit StuckBlock(const std::string& coulomb)
      : c(block(coulomb), "{slide: {stuck: true}}", {}),
        stuck(c.compiled.system),
        rates(c.compiled.system) {
    EXPECT_TRUE(
        c.compiled.assembly.solve_motion(c.design.parameters, &c.compiled.equations, &state).ok());
  }
  double acceleration() const { return state.z.head(c.compiled.system.layout().n).norm(); }
};

TEST(StuckJoints, HoldTheLoadOrSlideWithAWarning) {
  StuckBlock holds("20"), slides("2");
  EXPECT_TRUE(
      holds.stuck.hold(&holds.c.compiled.equations, &holds.state, &holds.rates, &holds.warnings)
          .ok());
  EXPECT_LT(holds.acceleration(), 1e-10);
  EXPECT_TRUE(holds.warnings.empty());
  EXPECT_TRUE(
      slides.stuck
          .hold(&slides.c.compiled.equations, &slides.state, &slides.rates, &slides.warnings)
          .ok());
  EXPECT_NEAR(slides.acceleration(), 9.81 * std::sin(0.25) - 1.0, 1e-6);
  ASSERT_EQ(slides.warnings.size(), 1U);
  EXPECT_EQ(slides.warnings[0].code, "start_slides");
}

TEST(StuckJoints, MustNotMove) {
  StuckBlock block("20");
  std::vector<std::size_t> contradicting;
  EXPECT_TRUE(
      block.stuck.require_rest(block.state, &block.c.compiled.equations, &contradicting).ok());
  block.state.v[0] = 0.1;
  EXPECT_EQ(block.stuck.require_rest(block.state, &block.c.compiled.equations, &contradicting).code,
            StatusCode::kInitialVelocityFailed);
  EXPECT_EQ(contradicting, std::vector<std::size_t>{0});
}

}  // namespace
}  // namespace codesign
