// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "statics/setpoint_motion.h"

#include <cmath>

#include "description/study.h"
#include "problem/load_problem.h"
#include "statics/statics_cases.h"

namespace codesign {
namespace {

SetpointMotion motion_of(const std::string& controllers) {
  const Problem problem = loaded(arm_urdf(), "duration: 2\ncontrollers: " + controllers + "\n");
  return {study_of(problem), problem.parameters()};
}

TEST(SetpointMotion, IsThatOfTheSetpoints) {
  const SetpointMotion motion = motion_of(
      "{swing: {type: pid, input: elbow/position, output: elbow, setpoint: {type: sine, amplitude: "
      "0.4, period: 2, offset: 0.1}, gains: {p: 1}}, hold: {type: pd_gravity, output: shoulder, "
      "setpoint: 0.3, gains: {p: 1, d: 0}}, brake: {type: pid, input: shoulder/velocity, output: "
      "shoulder, setpoint: 0, gains: {p: 1}}}");
  ASSERT_EQ(motion.joints().size(), 2U);
  EXPECT_EQ(motion.joints()[0].name, "elbow");
  EXPECT_EQ(motion.joints()[1].name, "shoulder");
  Eigen::VectorXd given[3];
  motion.at(0.3, &given);
  constexpr double kOmega = 3.141592653589793;
  EXPECT_NEAR(given[0][0], 0.1 + 0.4 * std::sin(0.3 * kOmega), 1e-14);
  EXPECT_NEAR(given[1][0], 0.4 * kOmega * std::cos(0.3 * kOmega), 1e-14);
  EXPECT_NEAR(given[2][0], -0.4 * kOmega * kOmega * std::sin(0.3 * kOmega), 1e-13);
  EXPECT_EQ(given[0][1], 0.3);
  EXPECT_EQ(given[1][1], 0.0);
  EXPECT_EQ(motion.some_positions(2.0).cols(), 4);
}

TEST(SetpointMotion, RefusesAStudyWithoutOne) {
  const std::string none = refused([] {
    motion_of(
        "{brake: {type: pid, input: shoulder/velocity, output: shoulder, setpoint: 0, gains: "
        "{p: 1}}}");
  });
  EXPECT_NE(none.find("study.yaml:1: controllers: the study gives no motion"), std::string::npos)
      << none;
  const std::string twice = refused([] {
    motion_of(
        "{a: {type: pid, input: elbow/position, setpoint: 0, gains: {p: 1}, output: elbow}, "
        "b: {type: pid, input: elbow/position, setpoint: 1, gains: {p: 1}, output: elbow}}");
  });
  EXPECT_NE(twice.find("controllers.b: two controllers, or a motion and a controller, give the "
                       "position of one joint"),
            std::string::npos)
      << twice;
}

TEST(SetpointMotion, HasTheMotionsThatTheStudyGives) {
  const Problem problem =
      loaded(arm_urdf(),
             "duration: 2\nmotion: {shoulder: {velocity: 0.5}}\ncontrollers: {swing: {type: pid, "
             "input: elbow/position, output: elbow, setpoint: 0.3, gains: {p: 1}}}\n");
  const SetpointMotion motion(study_of(problem), problem.parameters());
  ASSERT_EQ(motion.joints().size(), 2U);
  EXPECT_EQ(motion.joints()[0].name, "shoulder");
  Eigen::VectorXd given[3];
  motion.at(0.8, &given);
  EXPECT_NEAR(given[0][0], 0.4, 1e-15);
  EXPECT_EQ(given[1][0], 0.5);
  EXPECT_EQ(given[2][0], 0.0);
  EXPECT_EQ(given[0][1], 0.3);
}

}  // namespace
}  // namespace codesign
