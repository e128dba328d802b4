// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "control/signal.h"

#include <gtest/gtest.h>

#include "description/study.h"
#include "mechanism/topology.h"
#include "reading/urdf/urdf_fixture.h"

namespace codesign {
namespace {

/// ground - yaw - massless fork - pitch - arm, an end frame fixed to the arm, and a massless finger
/// on another hinge.
struct Fixture {
  RobotDescription robot = read_urdf(
      robot_text(kGround + link_with("fork", "") + link_with("arm") + link_with("camera", "") +
                 link_with("finger", "") +
                 joint_with("yaw", "continuous", "ground", "fork", "<axis xyz='0 0 1'/>") +
                 joint_with("pitch", "continuous", "fork", "arm", "<axis xyz='0 1 0'/>") +
                 joint_with("mount", "fixed", "arm", "camera", "<origin xyz='0 0 1'/>") +
                 joint_with("grip", "continuous", "arm", "finger")));
  Topology topology = derive_topology(robot);
  std::vector<ControllerDescription> controllers = {hold()};

  static ControllerDescription hold() {
    ControllerDescription controller;
    controller.name = "hold";
    controller.output = "pitch";
    controller.p = 1.0;
    return controller;
  }

  Signal resolve(const std::string& text) const {
    return resolve_signal(parse_signal(text, {"s.yaml", 4}, "signal"), robot, topology,
                          controllers);
  }
  Signal rate(const std::string& text) const {
    const SignalDescription description = parse_signal(text, {"s.yaml", 4}, "signal");
    return differentiate(resolve_signal(description, robot, topology, controllers), description,
                         "controllers.hold.input");
  }
  std::string refusal(const std::string& text) const {
    try {
      resolve(text);
    } catch (const InputError& error) {
      EXPECT_EQ(error.fault().where.line, 4);
      return error.what();
    }
    ADD_FAILURE() << "accepted " << text;
    return "";
  }
};

TEST(ResolveSignal, AJointOfAFoldedChainIsAnElementOfItsPair) {
  const Fixture fixture;
  const Signal signal = fixture.resolve("pitch/velocity - yaw/velocity");
  ASSERT_EQ(signal.size(), 2U);
  EXPECT_EQ(signal[0].kind, SignalKind::kJointVelocity);
  EXPECT_EQ(signal[0].pair, signal[1].pair);
  EXPECT_EQ(signal[0].element, 1);
  EXPECT_EQ(signal[1].element, 0);
  EXPECT_EQ(signal[0].factor, 1.0);
  EXPECT_EQ(signal[1].factor, -1.0);
}

TEST(ResolveSignal, ALinkHasComponentsAndAControllerNone) {
  const Fixture fixture;
  const Signal signal = fixture.resolve("camera/angular_velocity/z + hold/error + arm/position/y");
  ASSERT_EQ(signal.size(), 3U);
  EXPECT_EQ(signal[0].kind, SignalKind::kLinkAngularVelocity);
  EXPECT_EQ(signal[0].link, 3);
  EXPECT_EQ(signal[0].axis, 2);
  EXPECT_EQ(signal[1].kind, SignalKind::kControllerError);
  EXPECT_EQ(signal[1].controller, 0);
  EXPECT_EQ(signal[2].kind, SignalKind::kLinkPosition);
  EXPECT_EQ(signal[2].axis, 1);
}

TEST(ResolveSignal, WhatHasNoMassHasNothingToRead) {
  const Fixture fixture;
  EXPECT_NE(fixture.refusal("fork/position/x").find("no <inertial>"), std::string::npos);
  EXPECT_NE(fixture.refusal("grip/velocity").find("without <inertial>"), std::string::npos);
  EXPECT_NE(fixture.refusal("pich/velocity").find("pitch"), std::string::npos);
}

TEST(ResolveSignal, AReactionIsReadWhereTheChildHasMass) {
  const Fixture fixture;
  const Signal signal = fixture.resolve("pitch/reaction_torque/y");
  EXPECT_EQ(signal[0].kind, SignalKind::kReactionTorque);
  EXPECT_EQ(signal[0].pair, 0);
  EXPECT_EQ(signal[0].element, 1);
  EXPECT_EQ(signal[0].axis, 1);
  const std::string refused = fixture.refusal("yaw/reaction_force/x");
  EXPECT_NE(refused.find("where the reaction can be read"), std::string::npos) << refused;
  EXPECT_NE(refused.find("pitch/reaction_force/x, in the frame of that joint"), std::string::npos)
      << refused;
  EXPECT_NE(fixture.refusal("grip/reaction_force/x").find("without <inertial>"), std::string::npos);
  EXPECT_NE(fixture.refusal("mount/reaction_force/x").find("one body"), std::string::npos);
  EXPECT_THROW(fixture.rate("pitch/reaction_force/x"), InputError);
}

TEST(Differentiate, FollowsEachTerm) {
  const Fixture fixture;
  const Signal rate =
      fixture.rate("pitch/position + pitch/velocity - arm/position/x + arm/velocity/y");
  ASSERT_EQ(rate.size(), 4U);
  EXPECT_EQ(rate[0].kind, SignalKind::kJointVelocity);
  EXPECT_EQ(rate[1].kind, SignalKind::kJointAcceleration);
  EXPECT_EQ(rate[2].kind, SignalKind::kLinkVelocity);
  EXPECT_EQ(rate[2].factor, -1.0);
  EXPECT_EQ(rate[3].kind, SignalKind::kLinkAcceleration);
  EXPECT_EQ(rate[3].axis, 1);
  EXPECT_EQ(fixture.rate("hold/integral")[0].kind, SignalKind::kControllerError);
  EXPECT_EQ(fixture.rate("hold/error")[0].kind, SignalKind::kControllerErrorRate);
}

TEST(Differentiate, AForceHasNoRate) {
  const Fixture fixture;
  for (const char* text : {"pitch/acceleration", "pitch/effort", "hold/output",
                           "arm/angular_acceleration/x", "pitch/position + pitch/effort"})
    EXPECT_THROW(fixture.rate(text), InputError) << text;
}

TEST(ResolveSignal, AVectorIsToldInTheAxesOfALink) {
  const Fixture fixture;
  EXPECT_EQ(fixture.resolve("pitch/reaction_force/x")[0].axes, -1);
  EXPECT_EQ(fixture.resolve("pitch/reaction_force/x@ground")[0].axes, fixture.robot.root);
  EXPECT_EQ(fixture.resolve("pitch/reaction_force/x@camera")[0].axes, 3);
  EXPECT_EQ(fixture.resolve("arm/velocity/x@ground")[0].axes, -1);
  EXPECT_EQ(fixture.resolve("arm/velocity/x@arm")[0].axes, 2);
  EXPECT_EQ(fixture.resolve("camera/imu_acceleration/y")[0].axes, 3);
  EXPECT_EQ(fixture.resolve("camera/imu_acceleration/y@arm")[0].axes, 2);
  const Signal moment = fixture.resolve("mechanism/shaking_moment/y@arm");
  EXPECT_EQ(moment[0].kind, SignalKind::kShakingMoment);
  EXPECT_EQ(moment[0].axis, 1);
  EXPECT_EQ(moment[0].axes, 2);
  EXPECT_NE(fixture.refusal("arm/velocity/x@fork").find("its axes cannot be read"),
            std::string::npos);
}

// The angular velocity is the same to first order in the axes that it turns.
TEST(Differentiate, WhatIsToldInTurningAxesHasNoRateButTheirOwnAngularVelocity) {
  const Fixture fixture;
  EXPECT_EQ(fixture.rate("arm/angular_velocity/x")[0].kind, SignalKind::kLinkAngularAcceleration);
  EXPECT_EQ(fixture.rate("arm/angular_velocity/x@arm")[0].kind,
            SignalKind::kLinkAngularAcceleration);
  EXPECT_EQ(fixture.rate("arm/imu_angular_velocity/z")[0].kind,
            SignalKind::kImuAngularAcceleration);
  for (const char* text : {"arm/velocity/x@arm", "arm/angular_velocity/x@camera"})
    EXPECT_THROW(fixture.rate(text), InputError) << text;
}

TEST(ResolveSignal, AnExpressionHasItsSignalsInOrderParametersAndTheTime) {
  const Fixture fixture;
  const std::vector<Parameter> parameters{{"a", 0.5, 0.0, 1.0, "", {}}};
  const Signal signal =
      resolve_signal(parse_signal("${a*pitch/velocity*t + yaw/position}", {}, "signal"),
                     fixture.robot, fixture.topology, fixture.controllers, parameters);
  ASSERT_EQ(signal.size(), 2U);
  EXPECT_EQ(signal[1].kind, SignalKind::kJointPosition);
  ASSERT_TRUE(signal.formula);
  ASSERT_EQ(signal.formula->variables.size(), 4U);
  EXPECT_TRUE(signal.formula->variables[0].parameter);
  EXPECT_EQ(signal.formula->variables[1].term, 0);
  EXPECT_EQ(signal.formula->variables[3].term, 1);
  EXPECT_TRUE(reads_time(signal));
  EXPECT_FALSE(reads_time(fixture.resolve("${yaw/position^2}")));
  const std::optional<Signal> rate = differentiate(signal);
  ASSERT_TRUE(rate);
  EXPECT_TRUE(rate->is_rate);
  ASSERT_EQ(rate->size(), 4U);
  EXPECT_EQ((*rate)[2].kind, SignalKind::kJointAcceleration);
  EXPECT_EQ((*rate)[3].kind, SignalKind::kJointVelocity);
  EXPECT_FALSE(differentiate(*rate));
  EXPECT_FALSE(differentiate(fixture.resolve("${yaw/acceleration^2}")));
  EXPECT_NE(fixture.refusal("${b*pitch/velocity}").find("unknown parameter"), std::string::npos);
  EXPECT_NE(fixture.refusal("${pich/velocity^2}").find("did you mean"), std::string::npos);
}

TEST(ResolveSignal, ASpringHasForceLengthAndSpeed) {
  Fixture fixture;
  fixture.robot.spring_dampers.push_back({"strut", 0, 2, {}, {}, 1.0, 1.0, 1.0, {}});
  EXPECT_EQ(fixture.resolve("strut/force").front().kind,
            find_quantity(SignalOwner::kSpring, "force")->kind);
  EXPECT_EQ(fixture.resolve("strut/length").front().link_element, 0);
  EXPECT_EQ(fixture.rate("strut/length").front().kind,
            find_quantity(SignalOwner::kSpring, "speed")->kind);
  EXPECT_NE(fixture.refusal("strut/effort").find("force"), std::string::npos);
}

TEST(ResolveSignal, AnActuatorHasTorqueAndSpeed) {
  Fixture fixture;
  EXPECT_NE(fixture.refusal("pitch/motor_speed").find("motor_speed"), std::string::npos);
  fixture.robot.joints[1].actuator.emplace();
  EXPECT_EQ(fixture.resolve("pitch/motor_speed").front().kind, SignalKind::kMotorSpeed);
  EXPECT_EQ(fixture.resolve("pitch/motor_torque").front().kind, SignalKind::kMotorTorque);
}

}  // namespace
}  // namespace codesign
