// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "integration/command_inputs.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "integration/servo.h"

namespace codesign {
namespace {

using Names = std::vector<std::string>;

std::string arm_study(const std::string& controllers) {
  return "duration: 2.0\ninitial_state: {shoulder: {position: 0.1}}\ncontrollers:\n" + controllers +
         "parameters: {}\nobjective: {integral: [{signal: elbow/position}]}\n";
}

std::shared_ptr<const CompiledSystem> arm_with(const std::string& controllers) {
  return compile(double_pendulum(), arm_study(controllers));
}

const char* const kCascade =
    "  outer: {type: pid, input: shoulder/position, setpoint: 0.5, gains: {p: 3.0}}\n"
    "  inner: {type: pid, input: shoulder/velocity - outer/output, setpoint: 0.0, output: "
    "shoulder, gains: {p: 2.0}}\n"
    "  speed: {type: pid, input: elbow/velocity, setpoint: 1.0, output: elbow, gains: {p: 2.0}}\n";

template <class Make>
std::string message_of(const Make& make) {
  try {
    make();
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(CommandInputs, EveryDrivableJointTakesEffortsAheadOfTheStudysControllers) {
  const auto system = arm_with(kCascade);
  EXPECT_EQ(drivable_joints(*system), (Names{"shoulder", "elbow"}));
  const CommandInputs inputs(*system, {});
  EXPECT_EQ(inputs.joints, (Names{"shoulder", "elbow"}));
  EXPECT_EQ(inputs.controllers, (Names{"outer", "inner", "speed"}));
  ASSERT_EQ(inputs.study.controllers.size(), 5U);
  EXPECT_EQ(inputs.study.controllers[1].output, "elbow");
  EXPECT_EQ(inputs.study.controllers[2].name, "outer");
  EXPECT_EQ(inputs.study.duration, 2.0);
}

TEST(CommandInputs, AJointThatMovesNoMassOrFollowsAnotherIsNotDriven) {
  const auto system = compile(
      robot(bar("a") + bar("b") + "<link name='tip'/>" + hinge("first", "ground", "a", "0 0 0") +
            "<joint name='second' type='continuous'><parent link='a'/><child link='b'/><axis "
            "xyz='0 1 0'/>"
            "<mimic joint='first' multiplier='2'/></joint>" +
            hinge("last", "b", "tip", "0 0 -1")),
      motion_study(1.0, "{first: {position: 0.1}}", "first/position", "{}"));
  EXPECT_EQ(drivable_joints(*system), Names{"first"});
}

TEST(CommandInputs, AJointWhoseMotionIsGivenTakesNoEfforts) {
  const auto system =
      compile(double_pendulum(),
              "duration: 1.0\nmotion: {shoulder: {position: \"${0.3*sin(t)}\"}}\nobjective: "
              "{integral: [{signal: elbow/position}]}\n");
  EXPECT_EQ(drivable_joints(*system), Names{"elbow"});
  EXPECT_EQ(CommandInputs(*system, {}).joints, Names{"elbow"});
  CommandOptions options;
  options.joints = Names{"elbow", "shoulder"};
  const std::string said = message_of([&] { CommandInputs(*system, options); });
  for (const char* part : {"command_joints", "gives the motion", "value: shoulder", "elbow"})
    EXPECT_NE(said.find(part), std::string::npos) << said;
}

TEST(CommandInputs, ChosenJointsKeepTheirOrderAndWrongOnesAreRefused) {
  const auto system = arm_with(kCascade);
  CommandOptions options;
  options.joints = Names{"elbow", "shoulder"};
  EXPECT_EQ(CommandInputs(*system, options).joints, *options.joints);
  options.joints = Names{};
  EXPECT_TRUE(CommandInputs(*system, options).efforts.empty());
  options.joints = Names{"elbo"};
  EXPECT_NE(message_of([&] { CommandInputs(*system, options); }).find("did you mean \"elbow\""),
            std::string::npos);
  options.joints = Names{"elbow", "elbow"};
  EXPECT_NE(message_of([&] { CommandInputs(*system, options); }).find("twice"), std::string::npos);
}

TEST(CommandInputs, ADisconnectedControllerDrivesNothingAndTakesNoSetPoint) {
  const auto system = arm_with(kCascade);
  CommandOptions options;
  options.disconnected = {"speed"};
  const CommandInputs inputs(*system, options);
  EXPECT_EQ(inputs.controllers, (Names{"outer", "inner"}));
  EXPECT_EQ(inputs.study.controllers.back().output, "");
  options.disconnected = {"sped"};
  EXPECT_NE(message_of([&] { CommandInputs(*system, options); }).find("unknown controller"),
            std::string::npos);
  const auto heavy = arm_with(
      "  hold: {type: pd_gravity, setpoint: 0.0, output: shoulder, gains: {p: 2.0, d: 1.0}}\n");
  options.disconnected = {"hold"};
  EXPECT_NO_THROW(CompiledSystem(heavy->robot(), CommandInputs(*heavy, options).study));
}

TEST(CommandInputs, ALongerRunMayTakeAsManyStepsPerSecond) {
  const auto system = arm_with(kCascade);
  CommandOptions options;
  options.duration = 20.0;
  const CommandInputs inputs(*system, options);
  EXPECT_EQ(inputs.study.duration, 20.0);
  EXPECT_EQ(inputs.study.solver.maximum_steps, 10 * system->study().solver.maximum_steps);
  options.rate = 100.0;
  EXPECT_EQ(CommandInputs(*system, options).study.solver.maximum_steps,
            10 * system->study().solver.maximum_steps + 4000)
      << "two more for each command";
  options.duration = 1e9;
  EXPECT_GT(CommandInputs(*system, options).study.solver.maximum_steps, 1000000000);
}

TEST(CommandInputs, WithoutAControllerThatIsAppliedNoSpeedIsTooHigh) {
  const auto system = arm_with(kCascade);
  CommandOptions options;
  EXPECT_EQ(CommandInputs(*system, options).study.solver.maximum_speed, 0.0);
  for (const ControllerDescription& controller : system->study().controllers)
    options.disconnected.push_back(controller.name);
  EXPECT_GT(CommandInputs(*system, options).study.solver.maximum_speed, 1e6);
}

TEST(CommandInputs, ATrajectoryIsFollowedByPositionBeforeVelocity) {
  const CommandInputs inputs(*arm_with(kCascade), {});
  ASSERT_TRUE(follower_of(inputs, "shoulder"));
  EXPECT_EQ(inputs.controllers[follower_of(inputs, "shoulder")->controller], "outer");
  EXPECT_FALSE(follower_of(inputs, "shoulder")->by_rate);
  ASSERT_TRUE(follower_of(inputs, "elbow"));
  EXPECT_TRUE(follower_of(inputs, "elbow")->by_rate);
  // A controller that reads the elbow but drives the shoulder balances; it follows no trajectory of
  // the elbow.
  const auto balance = arm_with(
      "  balance: {type: pid, input: elbow/position, setpoint: 0.0, output: shoulder, gains: {p: "
      "2.0}}\n");
  EXPECT_FALSE(follower_of(CommandInputs(*balance, {}), "elbow"));
}

}  // namespace
}  // namespace codesign
