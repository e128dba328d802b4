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

TEST(StudyPositions, TakeThePlaceOfAMotion) {
  const std::string positions = "positions: {crank_joint: [0.1, 0.2]}\n";
  expect_fault(positions + "duration: 1\n", "duration", "in place of a motion", 2);
  expect_fault(positions + "controllers: {}\n", "controllers", "in place of a motion", 2);
  expect_fault(positions + "solver: {integrator: idas}\n", "solver.integrator", "not integrated",
               2);
  expect_fault(positions + "solver: {gradient: adjoint}\n", "solver.gradient", "no adjoint", 2);
  expect_fault(positions + "objective: {integral: []}\n", "objective.integral", "no integral", 2);
  expect_fault("duration: 1\nobjective: {sum: []}\n", "objective.sum", "no postures", 2);
  expect_fault(positions + "objective: {dwell: [{signal: slider/position/x, band: [0, 1]}]}\n",
               "objective.dwell[0]", "no times", 2);
  expect_fault(positions + "path: [{signal: slider/position/x, at_most: 1, after: 2}]\n", "path[0]",
               "the interval from 2 to 1 is not part", 2);
}

TEST(StudyPositions, RefuseBadLists) {
  expect_fault("positions: {}\n", "positions", "no joint", 1);
  expect_fault("positions: {crank_joint: []}\n", "positions.crank_joint", "found 0 postures", 1);
  expect_fault("positions: {crank_jiont: [1]}\n", "positions.crank_jiont",
               "did you mean \"crank_joint\"", 1);
  expect_fault("positions: {ball_joint: [1]}\n", "positions.ball_joint", "no single coordinate", 1);
  expect_fault("positions: {crank_joint: [0, x]}\n", "positions.crank_joint[1]", "not a number", 1);
  expect_fault("positions:\n  crank_joint: [0, 1]\n  slider_joint: [0, 1, 2]\n",
               "positions.slider_joint", "found 3 positions, and of joint 'crank_joint' 2", 3);
  expect_fault("positions: {crank_joint: {from: 0, to: 1, count: 1}}\n",
               "positions.crank_joint.count", "found 1 postures", 1);
  expect_fault("positions: {crank_joint: {from: 0, to: 1, count: 2.5}}\n",
               "positions.crank_joint.count", "found 2.5 postures", 1);
  expect_fault("positions: {crank_joint: {from: 0, count: 3}}\n", "positions.crank_joint.to",
               "required key is missing", 1);
  expect_fault("positions: {crank_joint: [0, 1]}\ninitial_state: {crank_joint: {position: 0.5}}\n",
               "positions.crank_joint", "initial_state gives", 1);
  expect_fault(
      "positions: {crank_joint: [0, 1]}\nobjective: {sum: [{signal: slider/position/x, "
      "reference: [1, 2, 3]}]}\n",
      "objective.sum[0].reference", "found 3 values for 2 postures", 2);
}

}  // namespace
}  // namespace codesign
