// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "problem/waypoint_overshoot.h"

#include <gtest/gtest.h>

namespace codesign {
namespace {

Study study_with(Interpolation interpolation, const std::vector<double>& positions, const std::vector<double>& velocities = {}) {
  Study study;
  ControllerDescription controller;
  controller.name = "hold";
  controller.where = {"study.yaml", 7};
  controller.setpoint.kind = ReferenceDescription::Kind::kWaypoints;
  WaypointsDescription& points = controller.setpoint.waypoints;
  points.interpolation = interpolation;
  for (std::size_t k = 0; k < positions.size(); ++k) points.times.push_back(static_cast<double>(k * k));
  points.positions.assign(positions.begin(), positions.end());
  points.velocities.assign(velocities.begin(), velocities.end());
  study.controllers = {controller};
  return study;
}

TEST(WaypointOvershoot, NamesTheCurveThatLeavesItsWayPoints) {
  const Warnings warnings = waypoint_overshoots(study_with(Interpolation::kQuintic, {0.0, 10.0, 10.0}));
  ASSERT_EQ(warnings.size(), 1U);
  EXPECT_EQ(warnings[0].code, "waypoint_overshoot");
  EXPECT_EQ(warnings[0].where.line, 7);
  for (const char* part : {"controllers.hold.setpoint", "0 to 10", "interpolation"})
    EXPECT_NE(warnings[0].message.find(part), std::string::npos) << warnings[0].message;
  EXPECT_EQ(waypoint_overshoots(study_with(Interpolation::kMonotone, {0.0, 1.0}, {-5.0, 0.0})).size(), 1U) << "given velocities";
}

TEST(WaypointOvershoot, SaysNothingOfCurvesWithinTheirWayPoints) {
  EXPECT_TRUE(waypoint_overshoots(study_with(Interpolation::kMonotone, {0.0, 10.0, 10.0})).empty());
  EXPECT_TRUE(waypoint_overshoots(study_with(Interpolation::kQuintic, {0.0, 1.0})).empty());
  EXPECT_TRUE(waypoint_overshoots(study_with(Interpolation::kQuintic, {2.0, 2.0, 2.0})).empty());
  EXPECT_TRUE(waypoint_overshoots(Study()).empty());
}

}  // namespace
}  // namespace codesign
