// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include "description/study.h"
#include "reading/study/study_blocks.h"
#include "reading/study/study_fixture.h"

namespace codesign {
namespace {

TEST(StudyPositions, AreListsOrEvenSteps) {
  const Study study = read_text(
      "positions:\n  crank_joint: [0.1, \"${10*rod_length}\", 0.5]\n"
      "  slider_joint: {from: 1.0, to: \"${rod_length}\", count: 3}\n"
      "initial_state: {crank_joint: {velocity: 2.0}}\n"
      "objective: {sum: [{signal: slider/position/x, reference: [0.3, 0.2, 0.1]}, {signal: "
      "crank_joint/velocity, reference: 2.0}], terminal: [{signal: slider/position/x}]}\n"
      "path: [{signal: slider/position/x, at_most: 1.0, after: 1}]\n"
      "final: [{signal: slider/position/x, at_least: 0.0}]\n");
  EXPECT_EQ(study.postures, 3);
  EXPECT_EQ(study.duration, 2.0);
  ASSERT_EQ(study.initial_state.size(), 2U);
  const InitialJointState& crank = study.initial_state[0];
  EXPECT_EQ(crank.velocity->nominal(), 2.0);
  EXPECT_EQ(crank.position->nominal(), 0.1);
  ASSERT_EQ(crank.positions.size(), 3U);
  EXPECT_DOUBLE_EQ(crank.positions[1].nominal(), 3.0);
  const std::vector<Quantity>& even = study.initial_state[1].positions;
  ASSERT_EQ(even.size(), 3U);
  const std::vector<double> longer{0.08, 0.4};
  EXPECT_DOUBLE_EQ(even[0].at(longer), 1.0);
  EXPECT_DOUBLE_EQ(even[1].at(longer), 0.7);
  EXPECT_DOUBLE_EQ(even[2].at(longer), 0.4);
  ASSERT_EQ(study.integral.size(), 2U);
  EXPECT_EQ(study.integral[0].reference.waypoints.times, (std::vector<double>{0.0, 1.0, 2.0}));
  EXPECT_EQ(study.integral[0].reference.waypoints.positions[1].nominal(), 0.2);
  EXPECT_EQ(study.watched[0].before, 2.0);
  EXPECT_EQ(study.watched[1].after, 2.0);
}

TEST(StudyPositions, OneIsEnough) {
  const Study study = read_text(
      "positions: {crank_joint: [0.1]}\n"
      "objective: {sum: [{signal: slider/position/x, reference: [0.3]}], peak: [{signal: "
      "slider/position/x}]}\n");
  EXPECT_EQ(study.postures, 1);
  EXPECT_EQ(study.duration, 0.0);
  EXPECT_EQ(study.integral[0].reference.constant.nominal(), 0.3);
}

}  // namespace
}  // namespace codesign
