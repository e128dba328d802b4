// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "assembly/singular_start.h"

#include <gtest/gtest.h>

#include <cmath>

#include "equations/compiled.h"

namespace codesign {
namespace {

constexpr double kStartCompliance = 1e-9;

/// A parallelogram: two hinged bars and a coupler as long as the distance of the hinges. Flat, at a
/// quarter turn, the bars may turn in the same or in opposite directions.
std::string parallelogram() {
  return robot(
      bar("left") + bar("right") + bar("coupler") + hinge("left_hinge", "ground", "left", "0 0 0") +
      hinge("right_hinge", "ground", "right", "1.2 0 0") +
      hinge("pin", "left", "coupler", "0 0 -1") +
      "<loop name='close' type='continuous'><predecessor link='right'><origin xyz='0 0 "
      "-1'/></predecessor>"
      "<successor link='coupler'><origin xyz='1.2 0 0'/></successor><axis xyz='0 1 0'/></loop>");
}

/// A slider-crank with crank and rod of 1 m: with the crank upright the slider is at the crank's
/// hinge. Then either rod and crank turn together or the slider moves on.
std::string equal_slider_crank() {
  return robot(bar("crank") + bar("rod") + bar("slider") +
               hinge("crank_hinge", "ground", "crank", "0 0 0") +
               hinge("pin", "crank", "rod", "0 0 -1") +
               "<joint name='slide' type='prismatic'><parent link='ground'/><child "
               "link='slider'/><axis xyz='1 0 0'/>"
               "<limit effort='1' velocity='1' lower='-9' upper='9'/></joint>"
               "<loop name='close' type='continuous'><predecessor link='rod'><origin xyz='0 0 "
               "-1'/></predecessor>"
               "<successor link='slider'/><axis xyz='0 1 0'/></loop>");
}

const std::string kQuarter = "1.5707963267948966";

std::string flat(const std::string& left, const std::string& right) {
  return "{left_hinge: {position: " + kQuarter + left + "}, right_hinge: {guess: " + kQuarter +
         right + "}, pin: {guess: -" + kQuarter + "}}";
}

struct Start {
  Start(const std::string& urdf, const std::string& initial, const std::string& signal)
      : compiled(urdf, let_go(initial, signal), kStartCompliance), status(compiled.start()) {}
  /// Rates of the tree's coordinates, computed from the bodies' angular velocities about y, omega =
  /// 2 G p'.
  double turn_rate(int body) const {
    const auto p = compiled.state.q.segment<4>(7 * body + 3),
               rate = compiled.state.v.segment<4>(7 * body + 3);
    return 2.0 * (-p[2] * rate[0] - p[3] * rate[1] + p[0] * rate[2] + p[1] * rate[3]);
  }
  Compiled compiled;
  Status status;
};

TEST(SingularStart, ARegularStartIsLeftAlone) {
  const Start start(parallelogram(), "{left_hinge: {position: 0.6, velocity: 2.0}}",
                    "left_hinge/velocity");
  ASSERT_TRUE(start.status.ok()) << start.status.cause;
  EXPECT_TRUE(start.compiled.assembly.warnings().empty());
  EXPECT_NEAR(start.turn_rate(1), 2.0, 1e-9);
}

TEST(SingularStart, GivenVelocitiesPickTheBranch) {
  const Start alike(parallelogram(), flat(", velocity: 2.0", ", velocity: 2.0"),
                    "left_hinge/velocity");
  ASSERT_TRUE(alike.status.ok()) << alike.status.cause;
  EXPECT_TRUE(alike.compiled.assembly.warnings().empty());
  EXPECT_NEAR(alike.turn_rate(0), 2.0, 1e-9);
  EXPECT_NEAR(alike.turn_rate(1), 2.0, 1e-9);
  // With sides of 1 and 1.2, folded flat, the second-order condition leaves w1 = w0 and w1 = -w0
  // / 11.
  const Start against(parallelogram(), flat(", velocity: 2.2", ", velocity: -0.2"),
                      "left_hinge/velocity");
  ASSERT_TRUE(against.status.ok()) << against.status.cause;
  EXPECT_TRUE(against.compiled.assembly.warnings().empty());
  EXPECT_NEAR(against.turn_rate(1), -0.2, 1e-9);
}

TEST(SingularStart, OneVelocityIsCompletedToAMotionAndAWarning) {
  const Start start(parallelogram(), flat(", velocity: 2.0", ""), "left_hinge/velocity");
  ASSERT_TRUE(start.status.ok()) << start.status.cause;
  EXPECT_NEAR(start.turn_rate(0), 2.0, 1e-9);
  EXPECT_TRUE(std::abs(start.turn_rate(1) - 2.0) < 1e-6 ||
              std::abs(start.turn_rate(1) + 2.0 / 11.0) < 1e-6)
      << start.turn_rate(1);
  ASSERT_EQ(start.compiled.assembly.warnings().size(), 1u);
  const Warning& warning = start.compiled.assembly.warnings()[0];
  EXPECT_EQ(warning.code, "singular_start");
  EXPECT_NE(warning.message.find("'left_hinge', 'right_hinge', 'pin'"), std::string::npos)
      << warning.message;
}

TEST(SingularStart, VelocitiesOfNoMotionAreRefusedAndTheJointsNamed) {
  const Start start(parallelogram(), flat(", velocity: 2.0", ", velocity: 1.0"),
                    "left_hinge/velocity");
  EXPECT_EQ(start.status.code, StatusCode::kSingularConfiguration);
  EXPECT_NE(start.status.cause.find("'left_hinge', 'right_hinge', 'pin'"), std::string::npos)
      << start.status.cause;
}

TEST(SingularStart, ASliderCrankOfEqualLengthsTakesEitherMotion) {
  const auto start_with = [](const std::string& slide) {
    return Start(equal_slider_crank(),
                 "{crank_hinge: {position: 3.141592653589793, velocity: 1.5}, pin: {guess: "
                 "3.141592653589793}, slide: {guess: 0.0" +
                     slide + "}}",
                 "crank_hinge/velocity");
  };
  // The rod turns with the crank and the slider stays, or the slider moves on by twice the crank's
  // speed.
  const Start with = start_with(", velocity: 0.0"), on = start_with(", velocity: 3.0"),
              wrong = start_with(", velocity: 1.0");
  EXPECT_TRUE(with.status.ok()) << with.status.cause;
  EXPECT_TRUE(on.status.ok() || start_with(", velocity: -3.0").status.ok());
  EXPECT_EQ(wrong.status.code, StatusCode::kSingularConfiguration);
}

TEST(Assembly, ContradictingVelocitiesAreNamed) {
  const Start start(parallelogram(),
                    "{left_hinge: {position: 0.6, velocity: 1.0}, right_hinge: {velocity: 2.0}, "
                    "pin: {velocity: 0.0}}",
                    "left_hinge/velocity");
  EXPECT_EQ(start.status.code, StatusCode::kInitialVelocityFailed);
  for (const char* name : {"'left_hinge'", "'right_hinge'", "'close'"})
    EXPECT_NE(start.status.cause.find(name), std::string::npos) << start.status.cause;
  EXPECT_FALSE(start.compiled.assembly.contradicting().empty());
}

}  // namespace
}  // namespace codesign
