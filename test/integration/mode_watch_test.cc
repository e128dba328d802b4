// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
// Motions whose formulas switch, theory (17d), against closed forms.
#include "integration/mode_watch.h"

#include <gtest/gtest.h>

#include <cmath>

#include "integration/driven_slides.h"
#include "integration/rosenbrock_integrator.h"

namespace codesign {
namespace {

std::string loaded_study(const std::string& load, const std::string& more = "") {
  return "duration: 2.0\ngravity: [0, 0, 0]\nloads: [{joint: slide, effort: \"" + load + "\"}]\n" +
         more;
}

std::string slide() { return robot(mass("piston", 2.0) + lift("slide", "piston", 0.0)); }

const char* const kTightTolerances =
    "solver: {relative_tolerance: 1.0e-10, absolute_tolerance: 1.0e-12}\n";

// 6 N on 2 kg from an instant on: the speed is exact, since no step crosses it.
TEST(ModeWatch, AStepOfTimeIsMetToRounding) {
  const std::string load = "${t < 0.7153 ? 0 : 6}";
  EXPECT_NEAR(end_of(slide(), loaded_study(load), 2.0, {"slide/velocity"})[0], 3.0 * (2.0 - 0.7153),
              1e-12);
}

// v = 1 m/s; inside |x - 0.4| < 1e-4 a force of 2e3 N acts: m v^2/2 grows by 2e3 * 2e-4 = 0.4 J.
TEST(ModeWatch, TwoCrossingsWithinAStepAreSeen) {
  const std::string load = "${abs(slide/position - 0.4) < 1.0e-4 ? 2000 : 0}",
                    start = "initial_state: {slide: {velocity: 1.0}}\n";
  EXPECT_NEAR(end_of(slide(), loaded_study(load, start), 2.0, {"slide/velocity"})[0],
              std::sqrt(1.0 + 2.0 * 0.4 / 2.0), 1e-8);
}

// A relay against a spring: x'' = -sign(x) on 2 kg with 2 N; from x = 1 the quarter of the period
// lasts sqrt(2) s, and the motion repeats after 4 sqrt(2) s.
TEST(ModeWatch, ARelaySwitchesAtEachPassage) {
  const std::string text =
      "duration: 40.0\ngravity: [0, 0, 0]\ninitial_state: {slide: {position: "
      "1.0}}\nloads: [{joint: slide, effort: \"${-2*sign(slide/position)}\"}]\n" +
      std::string(kTightTolerances);
  const double period = 4.0 * std::sqrt(2.0);
  EXPECT_NEAR(end_of(slide(), text, 7.0 * period, {"slide/position"})[0], 1.0, 1e-8);
}

// Dry friction by sign(): both sides of rest lead back to it.
TEST(ModeWatch, AMotionThatIsHeldAtASwitchHasAStatus) {
  const auto system = make_system(
      read_urdf({"slide.urdf", slide()}),
      read_study({"study.yaml", loaded_study("${-3*sign(slide/velocity)}",
                                             "initial_state: {slide: {velocity: 1.0}}\n")},
                 read_urdf({"slide.urdf", slide()})));
  RosenbrockIntegrator integrator(*system);
  Status status = integrator.start(system->parameters());
  while (status.ok() && integrator.state().t < 2.0) status = integrator.advance(2.0);
  EXPECT_EQ(status.code, StatusCode::kSwitchHolds) << describe(status);
  EXPECT_NEAR(status.time, 1.0 / 1.5, 1e-5) << "where the slide comes to rest";
  EXPECT_NE(status.cause.find("held at the switch of loads[0].effort, \"sign(slide/velocity)\""),
            std::string::npos)
      << status.cause;
  EXPECT_NE(status.cause.find("coulomb or gonthier"), std::string::npos);
}

/// The status of a run of 2 s at 1 m/s.
Status moving_status(const std::string& load) {
  const RobotDescription model = read_urdf({"slide.urdf", slide()});
  const auto system = make_system(
      model,
      read_study({"study.yaml", loaded_study(load, "initial_state: {slide: {velocity: 1.0}}\n")},
                 model));
  RosenbrockIntegrator integrator(*system);
  Status status = integrator.start(system->parameters());
  while (status.ok() && integrator.state().t < 2.0) status = integrator.advance(2.0);
  return status;
}

// Beyond x = 0.7 the root has no value, and comparisons with it no outcome.
TEST(ModeWatch, AGuardWithoutAValueEndsTheRunWhereItLosesIt) {
  const Status status = moving_status("${sqrt(0.7 - slide/position) > 2 ? 1 : 0}");
  EXPECT_EQ(status.code, StatusCode::kNonFinite) << describe(status);
  EXPECT_NEAR(status.time, 0.7, 1e-6);
  EXPECT_NE(status.cause.find("loads[0].effort, \"sqrt(0.7 - slide/position) > 2\""),
            std::string::npos)
      << status.cause;
}

TEST(ModeWatch, AGuardThatIsNotAskedForBehindASwitchNeedsNoValue) {
  const Status status =
      moving_status("${slide/position < 0.7 ? (sqrt(0.7 - slide/position) > 0.4 ? 1e-9 : 0) : 0}");
  EXPECT_TRUE(status.ok()) << describe(status);
}

// The rates are solved for again where the guard of an acceleration is zero: their rounding does
// not lead back over it.
TEST(ModeWatch, AGuardOfAnAccelerationIsPassedOnce) {
  const RobotDescription model = read_urdf({"pendulum.urdf", double_pendulum()});
  for (const char* solver : {"method: auto", "method: dopri5, coordinates: absolute",
                             "method: rodas5p", "method: rodas4, coordinates: absolute"}) {
    std::size_t events = 0;
    for (const char* threshold : {"-6", "-3", "-1", "0", "0.3", "1", "2.7", "5"}) {
      const std::string text =
          "duration: 1.5\ninitial_state: {shoulder: {position: -0.8}}\nobjective: {integral: "
          "[{signal: \"${elbow/acceleration < " +
          std::string(threshold) + " ? shoulder/velocity : 0}\"}]}\nsolver: {" + solver + "}\n";
      const auto system = make_system(model, read_study({"study.yaml", text}, model));
      RosenbrockIntegrator integrator(*system);
      Status status = integrator.start(system->parameters());
      while (status.ok() && integrator.state().t < 1.5) status = integrator.advance(1.5);
      EXPECT_TRUE(status.ok()) << describe(status);
      events += static_cast<std::size_t>(integrator.events().count());
    }
    // The passages of all thresholds, as many by every method.
    EXPECT_EQ(events, 32U) << solver;
  }
}

// The mode of every step is that of its beginning, and none is left without a switch.
TEST(ModeWatch, SystemsWithoutSwitchesHaveNoMode) {
  const RobotDescription model = read_urdf({"slide.urdf", slide()});
  const auto plain = make_system(model,
                                 read_study({"study.yaml", loaded_study("${3*sin(5*t)}")}, model)),
             switched = make_system(
                 model, read_study({"study.yaml", loaded_study("${max(0, t - 1)}")}, model));
  EXPECT_FALSE(plain->has_switches());
  ASSERT_TRUE(switched->has_switches());
  RosenbrockIntegrator integrator(*switched);
  ASSERT_TRUE(integrator.start(switched->parameters()).ok());
  const std::vector<bool> before = integrator.mode();
  double change = 0.0;
  while (integrator.state().t < 2.0) {
    ASSERT_TRUE(integrator.advance(2.0).ok());
    if (integrator.mode() == before) change = integrator.state().t;
  }
  EXPECT_NEAR(change, 1.0, 1e-14);
}

}  // namespace
}  // namespace codesign
