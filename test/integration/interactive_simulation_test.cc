// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "integration/interactive_simulation.h"

#include <gtest/gtest.h>

#include <cmath>

#include "integration/servo.h"
#include "integration/simulation_of.h"
#include "paths.h"
#include "problem/load_problem.h"

namespace codesign {
namespace {

const char* const kByRosenbrock =
    "{method: rodas5p, relative_tolerance: 1.0e-10, absolute_tolerance: 1.0e-11}";
const char* const kByIdas =
    "{integrator: idas, relative_tolerance: 1.0e-9, absolute_tolerance: 1.0e-11}";
constexpr double kInertia = 0.0834 + 0.25;  // of the bar about its hinge [kg m^2]

std::shared_ptr<const CompiledSystem> bar_at(const std::string& start, const std::string& solver,
                                             const std::string& more = "") {
  return compile(pendulum(),
                 "duration: 1.0\ninitial_state: {hinge: " + start +
                     "}\nparameters: {Kp: {initial: 20.0}}\n" + more +
                     "objective: {integral: [{signal: hinge/position}]}\nsolver: " + solver + "\n");
}

const char* const kHeldServo =
    "controllers: {servo: {type: pid, input: hinge/position, setpoint: 0.2, output: hinge, gains: "
    "{p: \"${Kp}\", i: 5.0, d: 2.0}}}\n";

JointSample hinge_at(InteractiveSimulation* run, double time) {
  Frame frame;
  EXPECT_TRUE(run->advance(time).ok());
  run->sample(time, &frame);
  return frame.joints[0];
}

class Commanded : public testing::TestWithParam<const char*> {};

TEST_P(Commanded, AHeldEffortSwingsASmallPendulumAsTheFormulaSays) {
  const auto system = bar_at("{position: 0.0}", GetParam());
  InteractiveSimulation run(*system, {}, {});
  ASSERT_TRUE(run.start(system->parameters()).ok());
  const double begin = 0.137, torque = 1e-4, stiffness = 9.81 * 0.5,
               omega = std::sqrt(stiffness / kInertia);
  ASSERT_TRUE(run.advance(begin).ok());
  run.set_effort(0, torque);
  ASSERT_TRUE(run.apply(begin).ok());
  for (double time : {0.2, 0.45, 0.7, 1.0}) {
    const JointSample hinge = hinge_at(&run, time);
    EXPECT_NEAR(hinge.position, torque / stiffness * (1.0 - std::cos(omega * (time - begin))),
                1e-10);
    EXPECT_NEAR(hinge.velocity, torque / stiffness * omega * std::sin(omega * (time - begin)),
                1e-9);
    EXPECT_EQ(hinge.effort, torque);
  }
}

// The same motion as two studies one after the other: the second begins with the last state of the
// first and has the effort as a load.
TEST_P(Commanded, AStepInEffortIsTheRunOfTwoStudies) {
  const auto first = bar_at("{position: 1.2}", GetParam());
  InteractiveSimulation run(*first, {}, {});
  ASSERT_TRUE(run.start(first->parameters()).ok());
  const JointSample middle = hinge_at(&run, 0.4);
  run.set_effort(0, -3.0);
  ASSERT_TRUE(run.apply(0.4).ok());
  const JointSample behind = hinge_at(&run, 0.4);
  EXPECT_NEAR(behind.position, middle.position, 1e-8);
  EXPECT_NEAR(behind.velocity, middle.velocity, 1e-7);
  EXPECT_NEAR(behind.acceleration, middle.acceleration - 3.0 / kInertia, 1e-7);
  char start[99];
  std::snprintf(start, sizeof start, "{position: %.17g, velocity: %.17g}", middle.position,
                middle.velocity);
  const auto second = bar_at(start, GetParam(), "loads: [{joint: hinge, effort: -3.0}]\n");
  Simulation other = simulation_of(second, second->parameters());
  Frame frame;
  ASSERT_TRUE(other.start().ok());
  ASSERT_TRUE(other.advance(0.5).ok());
  other.sample(0.5, &frame);
  const JointSample end = hinge_at(&run, 0.9);
  EXPECT_NEAR(end.position, frame.joints[0].position, 1e-7);
  EXPECT_NEAR(end.velocity, frame.joints[0].velocity, 1e-6);
  EXPECT_LT(run.statistics().energy_error, 1e-5);
}

TEST_P(Commanded, ASetPointFromTheStartIsThatOfAStudy) {
  const auto system = bar_at("{position: 0.5}", GetParam(), kHeldServo);
  std::string other = kHeldServo;
  other.replace(other.find("0.2"), 3, "0.7");
  InteractiveSimulation run(*system, {}, {}),
      study(*bar_at("{position: 0.5}", GetParam(), other), {}, {});
  ASSERT_TRUE(run.start({20.0}).ok());
  ASSERT_TRUE(study.start({20.0}).ok());
  run.set_course(0, held(0.7, 0.0));
  ASSERT_TRUE(run.apply(0.0).ok());
  EXPECT_TRUE(run.is_commanded(0));
  EXPECT_EQ(run.setpoint(0, 0.3).value, 0.7);
  for (double time : {0.3, 0.8})
    EXPECT_NEAR(hinge_at(&run, time).position, hinge_at(&study, time).position, 1e-7);
}

TEST_P(Commanded, AGainChangesTheMotionFromThenOn) {
  const auto system = bar_at("{position: 0.5}", GetParam(), kHeldServo);
  InteractiveSimulation run(*system, {}, {});
  ASSERT_TRUE(run.start({20.0}).ok());
  const JointSample before = hinge_at(&run, 0.25);
  Frame frame;
  run.sample(0.25, &frame);
  ASSERT_TRUE(run.change(0.25, {50.0}).ok());
  const JointSample behind = hinge_at(&run, 0.25);
  EXPECT_NEAR(behind.position, before.position, 1e-9);
  EXPECT_NEAR(behind.acceleration,
              before.acceleration + 30.0 * frame.controllers[0].error / kInertia, 1e-6);
  ASSERT_TRUE(run.start(run.parameters()).ok());
  EXPECT_EQ(run.parameters()[0], 50.0) << "the next run begins with the new value";
}

INSTANTIATE_TEST_SUITE_P(Integrators, Commanded, testing::Values(kByRosenbrock, kByIdas));

TEST(InteractiveSimulation, WithoutCommandsItTakesTheStepsOfTheStudy) {
  const auto system = servo("{relative_tolerance: 1.0e-6, absolute_tolerance: 1.0e-7}");
  InteractiveSimulation run(*system, {}, {parse_signal("servo/output", {}, "signal")});
  Simulation plain =
      simulation_of(system, system->parameters(), {parse_signal("servo/output", {}, "signal")});
  ASSERT_TRUE(run.start(system->parameters()).ok());
  ASSERT_TRUE(plain.start().ok());
  EXPECT_EQ(run.names().controllers, plain.names().controllers);
  Frame a, b;
  for (double time : {0.1, 0.33, 0.6}) {
    ASSERT_TRUE(run.advance(time).ok());
    ASSERT_TRUE(run.apply(time).ok());
    ASSERT_TRUE(plain.advance(time).ok());
    run.sample(time, &a);
    plain.sample(time, &b);
    ASSERT_EQ(a.controllers.size(), 1U);
    EXPECT_NEAR(a.controllers[0].output, b.controllers[0].output, 1e-9);
    EXPECT_NEAR(a.joints[1].position, b.joints[1].position, 1e-10);
    EXPECT_EQ(a.signals[0], a.controllers[0].output);
  }
  EXPECT_EQ(run.statistics().steps, plain.statistics().steps);
}

// Without friction and damping a held torque does the work torque times angle.
TEST(InteractiveSimulation, TheWorkOfHeldEffortsIsTheEnergyThatTheMechanismGains) {
  const auto system = bar_at("{position: 0.3}", kByRosenbrock);
  InteractiveSimulation run(*system, {}, {parse_signal("mechanism/total_energy", {}, "signal")});
  ASSERT_TRUE(run.start(system->parameters()).ok());
  Frame frame;
  run.sample(0.0, &frame);
  double energy = frame.signals[0], angle = frame.joints[0].position, effort = 0.0;
  for (int k = 1; k <= 100; ++k) {
    const double time = 0.01 * k;
    ASSERT_TRUE(run.advance(time).ok());
    run.sample(time, &frame);
    EXPECT_NEAR(frame.signals[0] - energy, effort * (frame.joints[0].position - angle), 1e-8)
        << time;
    energy = frame.signals[0];
    angle = frame.joints[0].position;
    effort = 4.0 * std::sin(0.3 * k);
    run.set_effort(0, effort);
    ASSERT_TRUE(run.apply(time).ok());
  }
}

TEST(InteractiveSimulation, ACourseBeginsItsPiecesOnTime) {
  const auto system = bar_at("{position: 0.2}", kByRosenbrock, kHeldServo);
  InteractiveSimulation run(*system, {}, {});
  ASSERT_TRUE(run.start({20.0}).ok());
  ASSERT_TRUE(run.advance(0.1).ok());
  run.set_course(
      0, trajectory_course({{0.333, 0.4, {}, {}}, {0.777, 0.0, {}, {}}}, 0.1, {0.2, 0.0, 0.0}));
  ASSERT_TRUE(run.apply(0.1).ok());
  Frame frame;
  for (double time : {0.2, 0.5, 0.9}) {
    ASSERT_TRUE(run.advance(time).ok());
    run.sample(time, &frame);
    const double expected = time < 0.333   ? 0.2 + 0.2 * (time - 0.1) / 0.233
                            : time < 0.777 ? 0.4 - 0.4 * (time - 0.333) / 0.444
                                           : 0.0;
    EXPECT_NEAR(frame.controllers[0].setpoint, expected, 1e-12) << time;
    ASSERT_TRUE(run.apply(time).ok());
  }
  ASSERT_TRUE(run.start({20.0}).ok());
  EXPECT_EQ(run.setpoint(0, 0.9).value, 0.2) << "a new run follows the study";
  ASSERT_TRUE(run.advance(0.9).ok());
}

TEST(InteractiveSimulation, ASampledControllerSeesANewSetPointAtItsNextSample) {
  const auto system = bar_at("{position: 0.0}", kByRosenbrock,
                             "controllers: {servo: {type: pid, input: hinge/position, setpoint: "
                             "0.0, output: hinge, gains: {p: 2.0}, "
                             "sample_time: 0.1}}\n");
  InteractiveSimulation run(*system, {}, {});
  ASSERT_TRUE(run.start({20.0}).ok());
  ASSERT_TRUE(run.advance(0.15).ok());
  run.set_course(0, held(1.0, 0.15));
  ASSERT_TRUE(run.apply(0.15).ok());
  EXPECT_EQ(hinge_at(&run, 0.19).effort, 0.0);
  EXPECT_NEAR(hinge_at(&run, 0.21).effort, 2.0, 1e-12);
}

// The effort of a command is an actuator's: limits bound its sum with the effort of the
// controllers.
TEST(InteractiveSimulation, TheLimitOfAnActuatorBoundsTheSum) {
  const std::string urdf = robot(bar("bar") +
                                 "<joint name='hinge' type='revolute'><parent "
                                 "link='ground'/><child link='bar'/><axis xyz='0 1 0'/>"
                                 "<limit lower='-3' upper='3' effort='2' velocity='9'/></joint>");
  const auto system = compile(urdf,
                              "duration: 1.0\ninitial_state: {hinge: {position: 0.0}}\nlimits: "
                              "{effort: true}\ncontrollers: {push: {type: "
                              "pid, input: hinge/position, setpoint: 1.0, output: hinge, gains: "
                              "{p: 1.5}}}\nparameters: {}\n"
                              "objective: {integral: [{signal: hinge/position}]}\n");
  InteractiveSimulation run(*system, {}, {});
  ASSERT_TRUE(run.start({}).ok());
  run.set_effort(0, 30.0);
  ASSERT_TRUE(run.apply(0.0).ok());
  EXPECT_NEAR(hinge_at(&run, 0.0).effort, 2.0, 0.02);
}

/// The shipped arm, which reaches its last way-point after 1.8 s and rests there, in a run of the
/// simulation node.
struct RestingArm {
  explicit RestingArm(double rate)
      : problem(load_problem(read_source(source_dir() + "/urdf/two_link_arm.urdf"), {},
                             read_source(source_dir() + "/config/two_link_arm.yaml"))) {
    CommandOptions options;
    options.duration = 1e6;
    options.rate = rate;
    run = std::make_unique<InteractiveSimulation>(*system_of(problem), options,
                                                  std::vector<SignalDescription>{});
  }

  Problem problem;
  std::unique_ptr<InteractiveSimulation> run;
};

// 120 such changes reached 0.00088 of the 0.001 that ends a run; with 150 it ended, and the message
// had the time 1e6 s.
TEST(InteractiveSimulation, ChangesOfAMechanismAtRestDoNotAddUpToAnEnergyError) {
  RestingArm arm(50.0);
  const std::vector<double> begun = arm.problem.parameters();
  std::vector<double> values = begun;
  ASSERT_TRUE(arm.run->start(begun).ok());
  for (int k = 1; k <= 1200; ++k) {
    const double time = 3.0 + 0.02 * k, part = k % 600 / 600.0;
    const Status status = arm.run->advance(time);
    ASSERT_TRUE(status.ok()) << k << ": " << status.cause;
    EXPECT_LT(arm.run->statistics().energy_error, 1e-4) << "after " << k << " changes";
    for (std::size_t p = 0; p < values.size(); ++p) values[p] = begun[p] * (1.0 + 0.5 * part);
    const Status change = arm.run->change(time, values);
    ASSERT_TRUE(change.ok()) << k << ": " << change.cause;
  }
  EXPECT_TRUE(arm.run->warnings().empty());
}

TEST(InteractiveSimulation, HoursAtRestEndNothing) {
  RestingArm arm(1.0);
  std::vector<double> values = arm.problem.parameters();
  ASSERT_TRUE(arm.run->start(values).ok());
  for (int k = 1; k <= 3600; ++k) {
    const double time = 4.0 * k;
    ASSERT_TRUE(arm.run->advance(time).ok()) << time;
    if (k % 300 != 0) continue;
    for (double& value : values) value *= 1.01;
    ASSERT_TRUE(arm.run->change(time, values).ok()) << time;
  }
  EXPECT_LT(arm.run->statistics().energy_error, 1e-4);
  EXPECT_TRUE(arm.run->warnings().empty());
}

// Without friction the error of each swing has the same sign; the run ended after 271 s.
TEST(InteractiveSimulation, HoursInMotionEndNothing) {
  const auto system = compile(pendulum(),
                              "duration: 5.0\ninitial_state: {hinge: {position: 2.0}}\n"
                              "objective: {integral: [{signal: hinge/position}]}\nsolver: "
                              "{coordinates: joint, relative_tolerance: 1e-4}\n");
  CommandOptions options;
  options.duration = 1e6;
  options.rate = 1.0;
  InteractiveSimulation run(*system, options, {});
  ASSERT_TRUE(run.start({}).ok());
  for (int k = 1; k <= 7200; ++k) {
    const Status status = run.advance(k);
    ASSERT_TRUE(status.ok()) << k << ": " << status.cause;
    if (k % 60 != 0) continue;
    run.set_effort(0, k % 120 == 0 ? 1e-3 : -1e-3);
    ASSERT_TRUE(run.apply(k).ok());
  }
}

// The step that finds the end may have begun before a command that changes it.
TEST(InteractiveSimulation, ACommandMayMoveTheEnd) {
  const auto system = bar_at("{position: 0.0, velocity: 2.0}", kByRosenbrock,
                             "until: \"${hinge/position > 0.2}\"\n");
  InteractiveSimulation run(*system, {}, {});
  ASSERT_TRUE(run.start(system->parameters()).ok());
  EXPECT_NEAR(hinge_at(&run, 0.5).position, 0.2, 1e-9);
  EXPECT_TRUE(run.has_ended());
  ASSERT_TRUE(run.start(system->parameters()).ok());
  EXPECT_FALSE(run.has_ended());
  const double begin = 0.09;
  ASSERT_LT(hinge_at(&run, begin).position, 0.2);
  EXPECT_FALSE(run.has_ended()) << "a step has found the end, the run has not come there yet";
  run.set_effort(0, -50.0);
  ASSERT_TRUE(run.apply(begin).ok());
  EXPECT_FALSE(run.has_ended());
  EXPECT_LT(hinge_at(&run, 0.12).position, 0.2);
  EXPECT_FALSE(run.has_ended());
}

TEST(InteractiveSimulation, AChangeMayMoveTheEnd) {
  const auto system = compile(
      pendulum(), "duration: \"${T}\"\nparameters: {T: {initial: 0.7, lower: 0.5, upper: 2.0}}\n");
  InteractiveSimulation run(*system, {}, {});
  EXPECT_EQ(run.duration(), 2.0);
  ASSERT_TRUE(run.start({0.8}).ok());
  EXPECT_EQ(run.end(), 0.8);
  ASSERT_TRUE(run.advance(0.3).ok());
  ASSERT_TRUE(run.change(0.3, {0.6}).ok());
  EXPECT_EQ(run.end(), 0.6);
  EXPECT_EQ(run.change(0.3, {2.5}).code, StatusCode::kInvalidDesign);
  EXPECT_EQ(run.end(), 0.6);
  CommandOptions options;
  options.duration = 10.0;
  InteractiveSimulation longer(*system, options, {});
  ASSERT_TRUE(longer.start({0.8}).ok());
  EXPECT_EQ(longer.end(), 10.0);
}

// A failure has the time of the run, and comes when the run has come there.
TEST(InteractiveSimulation, NoStepReachesFarBeyondTheTimeOfTheRun) {
  const auto system = bar_at("{position: 0.0}", kByRosenbrock);
  CommandOptions options;
  options.duration = 1e6;
  const InteractiveSimulation run(*system, options, {});
  EXPECT_EQ(run.inputs().study.solver.maximum_step, 1.0);
  EXPECT_EQ(run.inputs().study.balance_time, 1.0);
  EXPECT_EQ(InteractiveSimulation(*system, {}, {}).inputs().study.balance_time, 0.0);
}

}  // namespace
}  // namespace codesign
