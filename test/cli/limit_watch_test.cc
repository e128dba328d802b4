// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "jobs/run_recorder.h"

#include <gtest/gtest.h>

#include "cli/inputs.h"
#include "cli/run_fixture.h"

namespace codesign::cli {
namespace {

/// The vendor's arm: its elbow has the limits -3.1416, 3.1416, 150 N m and 3.15 rad/s.
Problem arm(const std::string& limits) {
  const ScratchFolder folder;
  Arguments arguments;
  arguments.model = shipped("test/cli/vendor/vx600.urdf");
  arguments.overlays = {shipped("test/cli/vendor/vx600_friction.urdf")};
  arguments.study = folder.edited(
      "study.yaml", read_text_file(shipped("test/cli/vendor/vx600.yaml")),
      "limits: {effort: true, position: true, stiffness: 1.0e+4, dissipation: 1.0, width: 1.0e-3}",
      limits);
  return load(arguments);
}

Frame at(double time, double position, double velocity, double effort) {
  Frame frame;
  frame.time = time;
  frame.joints = {{position, velocity, 0.0, effort}};
  return frame;
}

std::vector<LimitCrossing> watch(const std::string& limits, const std::vector<Frame>& frames) {
  const Problem problem = arm(limits);
  FrameNames names;
  names.joints = {"elbow_joint"};
  LimitWatch watch(problem, problem.parameters(), names);
  for (const Frame& frame : frames) watch.observe(frame);
  return watch.crossings();
}

TEST(LimitWatch, NotesFirstTimeAndWorstValueOfEachLimit) {
  const auto crossings = watch("limits: {}", {at(0.0, 3.1, -3.1, 149.0), at(0.1, 3.3, -3.5, -151.0),
                                              at(0.2, 3.2, 4.0, 10.0)});
  ASSERT_EQ(crossings.size(), 3U);
  EXPECT_EQ(crossings[0].limit, "upper");
  EXPECT_EQ(crossings[0].bound, 3.1416);
  EXPECT_EQ(crossings[0].worst, 3.3);
  EXPECT_EQ(crossings[0].time, 0.1);
  EXPECT_EQ(crossings[1].limit, "velocity");
  EXPECT_EQ(crossings[1].worst, 4.0);
  EXPECT_EQ(crossings[2].limit, "effort");
  EXPECT_EQ(crossings[2].worst, -151.0);
  EXPECT_EQ(
      describe(crossings[1]),
      "joint 'elbow_joint' exceeds its velocity limit 3.15 from t = 0.1 s; the worst value is 4");
}

TEST(LimitWatch, WhatTheTolerancesExplainIsNotReported) {
  const double margin = 1e-7 + 1e-6 * 3.1416;  // the study's tolerances
  EXPECT_TRUE(watch("limits: {}", {at(0.0, 3.1416 + 1e-15, 3.15 + 1e-15, 150.0 + 1e-13),
                                   at(0.1, -3.1416 - 0.9 * margin, -3.15, 0.0)})
                  .empty());
  const auto crossings =
      watch("limits: {}", {at(0.0, 3.1416 + 1.1 * margin, 3.15 + 4e-6, -150.0 - 2e-4)});
  ASSERT_EQ(crossings.size(), 3U);
  EXPECT_EQ(crossings[0].worst, 3.1416 + 1.1 * margin);
}

TEST(LimitWatch, WhatIsEnforcedIsNotReported) {
  const double gives_way = 0.02 * 2.0 * 3.1416;
  const auto crossings = watch("limits: {effort: true, position: true}",
                               {at(0.0, -3.1416 - 0.99 * gives_way, 3.2, 200.0)});
  ASSERT_EQ(crossings.size(), 1U);
  EXPECT_EQ(crossings[0].limit, "velocity");
  const auto beyond =
      watch("limits: {position: true}", {at(0.0, -3.1416 - 1.01 * gives_way, 0.0, 0.0)});
  ASSERT_EQ(beyond.size(), 1U) << "a stop that gives way by more than 2 % of its range";
  EXPECT_EQ(beyond[0].limit, "lower");
  EXPECT_EQ(watch("limits: {}", {at(0.0, -4.0, 0.0, 0.0)}).at(0).limit, "lower");
}

}  // namespace
}  // namespace codesign::cli
