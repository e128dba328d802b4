// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include "reading/study/study_blocks.h"
#include "reading/study/study_fixture.h"

namespace codesign {
namespace {

using Kind = ReferenceDescription::Kind;

std::string with_motion(const std::string& motion, const std::string& more = "") {
  return kLeastStudy + "motion: {crank_joint: " + motion + "}\n" + more;
}

TEST(StudyMotion, IsAPositionOrTheIntegralOfAVelocity) {
  const Study by_position = read_text(with_motion("{position: \"${crank_length*sin(2*t)}\"}"));
  ASSERT_EQ(by_position.motion.size(), 1U);
  EXPECT_EQ(by_position.motion[0].joint, "crank_joint");
  EXPECT_EQ(by_position.motion[0].where.line, 3);
  EXPECT_EQ(by_position.motion[0].position.kind, Kind::kExpression);
  EXPECT_EQ(by_position.used_parameters.count(0), 1U);

  const ReferenceDescription position =
      read_text(with_motion("{velocity: -10.0}",
                            "initial_state: {crank_joint: {position: \"${crank_length}\"}}\n"))
          .motion.at(0)
          .position;
  EXPECT_EQ(position.kind, Kind::kIntegral);
  EXPECT_EQ(position.integral.rate->constant.nominal(), -10.0);
  EXPECT_EQ(position.integral.start.nominal(), 0.08);
}

TEST(StudyMotion, RefusesVelocitiesThatJump) {
  const std::string at = "motion.crank_joint.position";
  const std::string points = "{position: {type: waypoints, times: [0.0, 1.0], positions: [0, 1], ";
  expect_fault(with_motion(points + "interpolation: linear}}"), at, "linear interpolation jumps",
               3);
  expect_fault(with_motion(points + "velocities: [0, 1]}}"), at, "held before the first way-point",
               3);
  read_text(
      with_motion("{position: {type: waypoints, times: [0.0, 2.0], positions: [0, 1], velocities: "
                  "[0, 1]}}"));
  read_text(
      with_motion("{velocity: {type: waypoints, times: [0.0, 1.0], positions: [0, 1], "
                  "interpolation: linear}}"));
  expect_fault(with_motion("{velocity: \"${t < 0.3 ? 0 : 2}\"}"), "motion.crank_joint.velocity",
               "the velocity jumps at 0.3 s", 3);
  read_text(with_motion("{velocity: \"${t < 0.3 ? 0 : 2*(t - 0.3)}\"}"));
}

}  // namespace
}  // namespace codesign
