// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
// URDF's <limit> in motion: stops and saturated actuators.
#include <gtest/gtest.h>

#include "integration/energy_balance.h"
#include "integration/servo.h"
#include "integration/simulation_of.h"
#include "mechanism_codesign/simulation.h"

namespace codesign {
namespace {

/// A bar on a hinge that may turn between -0.6 and 0.3 only.
std::string bounded_pendulum(const std::string& type = "revolute",
                             const std::string& limit = "lower='-0.6' upper='0.3'") {
  return robot(bar("bar") + "<joint name='hinge' type='" + type +
               "'><parent link='ground'/><child link='bar'/><axis xyz='0 1 0'/><limit effort='2' "
               "velocity='5' " +
               limit + "/></joint>");
}

std::string study(const std::string& limits, double duration = 2.0) {
  return motion_study(duration, "{hinge: {position: -0.5, velocity: 1.0}}", "hinge/velocity",
                      kFriction) +
         "limits: " + limits + "\n";
}

struct Range {
  double least = 1e9, most = -1e9, last = 0.0;
};

Range positions(const std::string& urdf, const std::string& study_text, double duration = 2.0) {
  Range range;
  Simulation simulation = simulation_of(compile(urdf, study_text), {},
                                        {parse_signal("hinge/position", {"test", 0}, "signal")});
  const Status status = simulate(&simulation, duration, 401, [&range](const Frame& frame) {
    range.last = frame.signals[0];
    range.least = std::min(range.least, range.last);
    range.most = std::max(range.most, range.last);
    return true;
  });
  EXPECT_TRUE(status.ok()) << status.cause;
  return range;
}

TEST(Limits, StopsHoldAJointWithinAndAreOffByDefault) {
  const Range bounded = positions(bounded_pendulum(), study("{position: true}"));
  EXPECT_GT(bounded.most, 0.3);
  EXPECT_LT(bounded.most, 0.3 + 0.03);
  EXPECT_GT(bounded.least, -0.6 - 0.03);
  EXPECT_GT(positions(bounded_pendulum(), study("{position: false}")).most, 0.55);
  EXPECT_EQ(positions(bounded_pendulum(), study("{}")).most,
            positions(bounded_pendulum(), study("{effort: true}")).most);
}

TEST(Limits, ContinuousJointsAndEqualLimitsHaveNoStops) {
  EXPECT_GT(positions(bounded_pendulum("continuous"), study("{position: true}")).most, 0.55);
  EXPECT_GT(positions(bounded_pendulum("revolute", ""), study("{position: true}")).most, 0.55);
}

TEST(Limits, AStopWithoutDissipationGivesBackAllOfIt) {
  const Balance b = balance(bounded_pendulum(), study("{position: true, dissipation: 0.0}"));
  ASSERT_TRUE(b.status.ok()) << b.status.cause;
  EXPECT_LT(b.largest_drift, 1e-6);
}

TEST(Limits, AStopWithDissipationOnlyTakes) {
  const Balance b = balance(
      bounded_pendulum(), study("{position: true, dissipation: 0.5, stiffness: 2e3, width: 2e-3}"));
  ASSERT_TRUE(b.status.ok()) << b.status.cause;
  EXPECT_LT(b.end, b.start - 0.3);
}

TEST(Limits, AJointRestsOnItsStopAsDeepAsItsWeightPresses) {
  // Gravity along x turns the bar onto the upper stop with about 1 kg g/2 cos 0.3.
  std::string resting =
      study("{position: true, dissipation: 5.0, stiffness: 1e3, width: 1e-3}", 8.0) +
      "gravity: [-9.81, 0.0, 0.0]\n";
  const Range range = positions(bounded_pendulum(), resting, 8.0);
  const double depth = 0.5 * 9.81 * std::cos(range.last) / 1e3;
  EXPECT_NEAR(range.last, 0.3 + depth + 0.5e-3, 1e-6);
}

const char* const kServo =
    "controllers: {servo: {type: pid, input: hinge/position, setpoint: 2.0, output: hinge, gains: "
    "{p: 1000.0, d: 5.0}}}\n";

std::string servo_limits(const std::string& limits) {
  return "duration: 0.1\ngravity: [0.0, 0.0, 0.0]\n" + std::string(kServo) +
         "objective: {integral: [{signal: hinge/velocity}]}\nlimits: " + limits + "\n";
}

Frame at_end(const std::string& urdf, const std::string& limits) {
  Simulation simulation = simulation_of(compile(urdf, servo_limits(limits)), {},
                                        {parse_signal("hinge/effort", {"test", 0}, "signal"),
                                         parse_signal("servo/output", {"test", 0}, "signal")});
  Frame last;
  EXPECT_TRUE(simulate(&simulation, 0.1, 2, [&last](const Frame& frame) {
                last = frame;
                return true;
              }).ok());
  return last;
}

TEST(Limits, AnActuatorGivesNoMoreThanItsEffort) {
  const Frame frame = at_end(bounded_pendulum("continuous"), "{effort: true}");
  // 2 N m on 0.3334 kg m^2 from rest, for 0.1 s; the demand is a thousand times that.
  EXPECT_NEAR(frame.joints[0].velocity, 2.0 / 0.3334 * 0.1, 1e-6);
  EXPECT_NEAR(frame.signals[0], 2.0, 1e-6);
  EXPECT_EQ(frame.joints[0].effort, frame.signals[0]);
  EXPECT_GT(frame.signals[1], 1000.0) << "what the controller asks for";
  EXPECT_GT(std::abs(at_end(bounded_pendulum("continuous"), "{}").joints[0].velocity), 10.0);
}

TEST(Limits, AnEffortOfZeroIsNoRating) {
  std::string unrated = bounded_pendulum("continuous");
  unrated.replace(unrated.find("effort='2'"), 10, "effort='0'");
  EXPECT_GT(std::abs(at_end(unrated, "{effort: true}").joints[0].velocity), 10.0);
}

}  // namespace
}  // namespace codesign
