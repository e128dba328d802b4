// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "mechanism_codesign/simulation.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <thread>
#include <vector>

#include "assembly/make_system.h"
#include "equations/compiled.h"
#include "integration/simulation_of.h"

namespace codesign {
namespace {

const char* const kTight =
    "solver: {method: rodas5p, relative_tolerance: 1.0e-10, absolute_tolerance: 1.0e-11}\n";

std::shared_ptr<const CompiledSystem> system_of(const std::string& urdf, const std::string& study) {
  const RobotDescription robot = read_urdf({"test.urdf", urdf});
  return make_system(robot, read_study({"test.yaml", study}, robot));
}

/// A small swing of a bar, and its angular frequency: the root of 9.81 * 0.5 over its moment of
/// inertia about the hinge.
std::shared_ptr<const CompiledSystem> small_swing() {
  return system_of(pendulum(), let_go("{hinge: {position: 1.0e-4}}", "hinge/position", kTight));
}
const double kFrequency = std::sqrt(9.81 * 0.5 / (0.0834 + 0.25));

TEST(Simulation, ASmallSwingIsHarmonicBetweenStepsToo) {
  Simulation simulation =
      simulation_of(small_swing(), {}, {parse_signal("hinge/velocity", {}, "signal")});
  std::vector<double> times;
  const Status status = simulate(&simulation, 1.0, 51, [&](const Frame& frame) {
    times.push_back(frame.time);
    const double phase = kFrequency * frame.time;
    EXPECT_NEAR(frame.joints[0].position, 1e-4 * std::cos(phase), 1e-11);
    EXPECT_NEAR(frame.signals[0], -1e-4 * kFrequency * std::sin(phase), 1e-10);
    EXPECT_NEAR(frame.joints[0].acceleration, -1e-4 * kFrequency * kFrequency * std::cos(phase),
                1e-9);
    return true;
  });
  ASSERT_TRUE(status.ok()) << status.cause;
  ASSERT_EQ(times.size(), 51U);
  EXPECT_EQ(times.front(), 0.0);
  EXPECT_EQ(times.back(), 1.0);
}

TEST(Simulation, TheObjectiveGrowsToItsIntegral) {
  Simulation simulation = simulation_of(small_swing(), {});
  Frame frame;
  ASSERT_TRUE(simulation.start().ok());
  ASSERT_TRUE(simulation.advance(1.0).ok());
  simulation.sample(1.0, &frame);
  // The integral of (a cos wt)^2 from 0 to 1.
  const double expected = 1e-8 * (0.5 + std::sin(2.0 * kFrequency) / (4.0 * kFrequency));
  EXPECT_NEAR(frame.objective, expected, 1e-6 * expected);
}

TEST(Simulation, TheInstantsAskedForDoNotChangeTheRun) {
  Frame coarse, fine;
  const auto last = [](Frame* frame) {
    return [frame](const Frame& f) {
      *frame = f;
      return true;
    };
  };
  Simulation a = simulation_of(small_swing(), {}), b = simulation_of(small_swing(), {});
  ASSERT_TRUE(simulate(&a, 1.0, 2, last(&coarse)).ok());
  ASSERT_TRUE(simulate(&b, 1.0, 201, last(&fine)).ok());
  EXPECT_EQ(coarse.joints[0].position, fine.joints[0].position);
  EXPECT_EQ(a.statistics().steps, b.statistics().steps);
}

TEST(Simulation, RunsOnBeyondTheDuration) {
  Simulation simulation = simulation_of(small_swing(), {});
  Frame frame;
  ASSERT_TRUE(simulation.start().ok());
  for (double time : {0.5, 1.0, 1.7, 3.0}) {
    ASSERT_TRUE(simulation.advance(time).ok());
    simulation.sample(time, &frame);
    EXPECT_NEAR(frame.joints[0].position, 1e-4 * std::cos(kFrequency * time), 1e-10);
  }
}

std::shared_ptr<const CompiledSystem> swing_that_ends(const std::string& end) {
  return system_of(pendulum(),
                   end +
                       "initial_state: {hinge: {position: 1.0e-4}}\nobjective: {integral: "
                       "[{signal: hinge/position}], terminal: [{signal: hinge/velocity}]}\n" +
                       kTight);
}

/// The objective of the small swing at the time t.
double objective_of_swing(double t) {
  const double speed = 1e-4 * kFrequency * std::sin(kFrequency * t);
  return 1e-8 * (0.5 * t + std::sin(2.0 * kFrequency * t) / (4.0 * kFrequency)) + speed * speed;
}

TEST(Simulation, AConditionEndsIt) {
  Simulation simulation =
      simulation_of(swing_that_ends("duration: 2.0\nuntil: \"${hinge/position < 0.5e-4}\"\n"), {});
  const double end = std::acos(0.5) / kFrequency;
  Frame frame;
  ASSERT_TRUE(simulation.start().ok());
  EXPECT_FALSE(simulation.has_ended());
  EXPECT_EQ(simulation.end(), 2.0);
  for (const double time : {0.1, 1.0, 3.0}) {
    ASSERT_TRUE(simulation.advance(time).ok());
    simulation.sample(time, &frame);
    EXPECT_NEAR(frame.time, std::min(time, end), 1e-8);
    EXPECT_NEAR(frame.joints[0].position, 1e-4 * std::cos(kFrequency * std::min(time, end)), 1e-11);
  }
  EXPECT_TRUE(simulation.has_ended());
  EXPECT_NEAR(simulation.time(), end, 1e-8);
  EXPECT_NEAR(simulation.objective(), objective_of_swing(end), 1e-6 * objective_of_swing(end));
  std::vector<double> times;
  ASSERT_TRUE(simulate(&simulation, 2.0, 11, [&times](const Frame& at) {
                times.push_back(at.time);
                return true;
              }).ok());
  ASSERT_EQ(times.size(), 11U);
  EXPECT_NEAR(times[5], end / 2.0, 1e-8);
  EXPECT_NEAR(times[10], end, 1e-8);
}

TEST(Simulation, ItsParametersMayEndIt) {
  const auto system = swing_that_ends(
      "duration: \"${T}\"\nparameters: {T: {initial: 0.7, lower: 0.5, upper: 2.0}}\n");
  Simulation simulation = simulation_of(system, {0.9});
  std::vector<double> times;
  ASSERT_TRUE(simulate(&simulation, 2.0, 10, [&times](const Frame& at) {
                times.push_back(at.time);
                return true;
              }).ok());
  EXPECT_EQ(simulation.end(), 0.9);
  EXPECT_EQ(simulation.time(), 0.9);
  EXPECT_DOUBLE_EQ(times.back(), 0.9);
  EXPECT_NEAR(times[5], 0.5, 1e-15);
  EXPECT_NEAR(simulation.objective(), objective_of_swing(0.9), 1e-6 * objective_of_swing(0.9));
  for (const double duration : {0.0, -1.0, 2.1}) {
    Simulation impossible = simulation_of(system, {duration});
    const Status status = impossible.start();
    EXPECT_EQ(status.code, StatusCode::kInvalidDesign);
    EXPECT_NE(status.cause.find("must be above 0 s and at most 2 s"), std::string::npos)
        << status.cause;
  }
}

TEST(Simulation, ContinuousJointsCountTheirTurns) {
  Simulation simulation = simulation_of(
      system_of(pendulum(),
                let_go("{hinge: {position: 14.0, velocity: 20.0}}", "hinge/velocity", kTight)),
      {});
  double previous = 14.0;
  const Status status = simulate(&simulation, 1.0, 101, [&](const Frame& frame) {
    EXPECT_GE(frame.joints[0].position, previous);
    EXPECT_LT(frame.joints[0].position, previous + 0.5);
    previous = frame.joints[0].position;
    return true;
  });
  ASSERT_TRUE(status.ok());
  EXPECT_GT(previous, 14.0 + 12.0);
}

TEST(Simulation, AnObserverMayEndIt) {
  Simulation simulation = simulation_of(small_swing(), {});
  int frames = 0;
  const Status status =
      simulate(&simulation, 1.0, 11, [&frames](const Frame&) { return ++frames < 3; });
  EXPECT_EQ(status.code, StatusCode::kCancelled);
  EXPECT_NEAR(status.time, 0.2, 1e-15);
  EXPECT_EQ(frames, 3);
}

TEST(Simulation, ObeysACancelBetweenSamplesToo) {
  double reached = 0.0;
  // A cancel may come before the first step; a later one does not.
  for (auto wait = std::chrono::milliseconds(20); reached == 0.0; wait *= 2) {
    Simulation simulation = simulation_of(small_swing(), {});
    std::atomic<bool> cancel{false};
    std::thread other([&] {
      std::this_thread::sleep_for(wait);
      cancel = true;
    });
    int frames = 0;
    const Status status = simulate(
        &simulation, 1e7, 2, [&frames](const Frame&) { return ++frames < 3; }, &cancel);
    other.join();
    ASSERT_EQ(status.code, StatusCode::kCancelled);
    EXPECT_EQ(frames, 1) << "the start alone";
    reached = status.time;
  }
  EXPECT_LT(reached, 1e7);
}

}  // namespace
}  // namespace codesign
