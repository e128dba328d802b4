// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
// Accelerations of links and what an IMU on them shows, by hand.
#include "elements/link_axes.h"

#include <gtest/gtest.h>

#include "equations/compiled.h"
#include "equations/equations_fixture.h"
#include "equations/formulas.h"
#include "equations/generic_state.h"

namespace codesign {
namespace {

/// A bar on a hinge about y, whose tool is 2 m below the hinge and turned about x by a right angle.
std::string bar_with_tool() {
  return robot(bar("arm") +
               "<link name='tool'/><joint name='hinge' type='continuous'><parent "
               "link='ground'/><child link='arm'/><axis xyz='0 1 0'/></joint>"
               "<joint name='mount' type='fixed'><parent link='arm'/><child link='tool'/><origin "
               "xyz='0 0 -2' rpy='1.5707963267948966 0 0'/></joint>");
}

double link_value(Compiled* c, const std::string& text) {
  return c->equations.formulas().signal(
      resolve_signal(parse_signal(text, {}, "test"), c->system.robot(), c->system.topology(), {}),
      c->state);
}

Eigen::Vector3d link_vector(Compiled* c, const std::string& quantity,
                            const std::string& axes = "") {
  return {link_value(c, quantity + "/x" + axes), link_value(c, quantity + "/y" + axes),
          link_value(c, quantity + "/z" + axes)};
}

class AnyCoordinates : public ::testing::TestWithParam<const char*> {
 protected:
  static std::string solver() { return std::string("solver: {coordinates: ") + GetParam() + "}\n"; }
};

// At an angle theta about y the arm's z is (sin theta, 0, cos theta); the tool's y is the arm's z,
// its z the arm's -y.
TEST_P(AnyCoordinates, OfATurningBarByHand) {
  constexpr double kTheta = 0.7, kRate = -3.0, kLength = 2.0;
  Compiled c(bar_with_tool(),
             let_go("{hinge: {position: 0.7, velocity: -3.0}}", "hinge/position", solver()));
  ASSERT_TRUE(c.start().ok());
  const double alpha = link_value(&c, "hinge/acceleration");
  EXPECT_GT(std::abs(alpha), 1.0);
  const Eigen::Vector3d x(std::cos(kTheta), 0.0, -std::sin(kTheta)),
      z(std::sin(kTheta), 0.0, std::cos(kTheta));
  // r = -L z, z' = rate x, x' = -rate z
  const Eigen::Vector3d acceleration = -kLength * (alpha * x - kRate * kRate * z);
  EXPECT_LT((link_vector(&c, "tool/acceleration") - acceleration).norm(), 1e-11);
  EXPECT_LT((link_vector(&c, "tool/angular_acceleration") - Eigen::Vector3d(0, alpha, 0)).norm(),
            1e-12);
  const Eigen::Vector3d velocity = -kLength * kRate * x;
  EXPECT_LT((link_vector(&c, "tool/velocity", "@tool") -
             Eigen::Vector3d(velocity.dot(x), velocity.dot(z), 0.0))
                .norm(),
            1e-12);
  const Eigen::Vector3d shown = acceleration + Eigen::Vector3d(0, 0, 9.81);
  EXPECT_LT(
      (link_vector(&c, "tool/imu_acceleration") - Eigen::Vector3d(shown.dot(x), shown.dot(z), 0.0))
          .norm(),
      1e-11);
  EXPECT_LT((link_vector(&c, "tool/imu_angular_velocity") - Eigen::Vector3d(0, 0, -kRate)).norm(),
            1e-12);
  EXPECT_LT((link_vector(&c, "tool/imu_acceleration", "@ground") - shown).norm(), 1e-11);
}

// An IMU that lies shows g upward, and one that falls shows nothing, however it turns.
TEST_P(AnyCoordinates, AnImuShowsWhatAccelerometersAndGyroscopesDo) {
  Compiled c(robot(bar("box") + "<joint name='free' type='floating'><parent link='ground'/><child "
                                "link='box'/></joint>"),
             std::string("duration: 1.0\ninitial_state: {free: {rotation: [0.4, -0.3, 1.2], "
                         "angular_velocity: [0, 0, 0]}}\n") +
                 solver());
  ASSERT_TRUE(c.start().ok());
  EXPECT_NEAR(link_value(&c, "box/acceleration/z"), -9.81, 1e-12);
  EXPECT_LT(link_vector(&c, "box/imu_acceleration").norm(), 1e-11);
  Compiled resting(
      robot(bar("arm") + "<joint name='hinge' type='continuous'><parent "
                         "link='ground'/><child link='arm'/><axis xyz='0 1 0'/></joint>"),
      "duration: 1.0\n" + solver());
  ASSERT_TRUE(resting.start().ok());
  EXPECT_LT((link_vector(&resting, "arm/imu_acceleration") - Eigen::Vector3d(0, 0, 9.81)).norm(),
            1e-12);
  EXPECT_LT((link_vector(&resting, "ground/imu_acceleration") - Eigen::Vector3d(0, 0, 9.81)).norm(),
            1e-12);
}

// The rates of positions and of the angular velocity in its own axes, by differences along the
// motion.
TEST_P(AnyCoordinates, TheGyroscopesRateIsTheAccelerationThatControllersDeriveFromIt) {
  Compiled c(robot(bar("box") + "<joint name='free' type='floating'><parent link='ground'/><child "
                                "link='box'/></joint>"),
             std::string("duration: 1.0\n") + solver());
  ASSERT_TRUE(c.start().ok());
  ASSERT_TRUE(scramble(&c));
  const auto omega = [&c](const State<double>& at) {
    State<double> kept = at;
    std::swap(kept, c.state);
    const Eigen::Vector3d value = link_vector(&c, "box/imu_angular_velocity");
    std::swap(kept, c.state);
    return value;
  };
  const double h = 1e-6;
  State<double> later = c.state, before = c.state;
  const Eigen::Index n = c.system.layout().n;
  if (c.system.layout().has_forest()) GTEST_SKIP() << "coordinates whose rates are not v";
  later.q += h * c.state.v;
  later.v += h * c.state.z.head(n);
  before.q -= h * c.state.v;
  before.v -= h * c.state.z.head(n);
  const Eigen::Vector3d rate = (omega(later) - omega(before)) / (2.0 * h);
  EXPECT_GT(rate.norm(), 0.1);
  EXPECT_LT((link_vector(&c, "box/angular_acceleration", "@box") - rate).norm(),
            1e-7 * (1.0 + rate.norm()));
}

INSTANTIATE_TEST_SUITE_P(LinkAxes, AnyCoordinates, ::testing::Values("absolute", "joint"));

TEST(LinkAxes, GradientsAreExact) {
  EquationsFixture e(
      bar_with_tool(),
      "duration: 1.0\nobjective: {integral: [{signal: tool/acceleration/x}, {signal: "
      "tool/angular_acceleration/y}, {signal: tool/imu_acceleration/y}, {signal: "
      "tool/imu_angular_velocity/z}, {signal: tool/velocity/x@arm}, {signal: "
      "mechanism/shaking_force/z@tool}, {signal: mechanism/shaking_moment/z@tool}]}\n"
      "solver: {coordinates: absolute}\n");
  e.expect_exact_derivatives(1e-9);
}

}  // namespace
}  // namespace codesign
