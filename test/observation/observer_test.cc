// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "observation/observer.h"

#include <gtest/gtest.h>

#include <cmath>

#include "equations/compiled.h"

namespace codesign {
namespace {

/// The frame observed at the start of a study.
struct Observed {
  Compiled compiled;
  Observer observer;
  Frame frame;

  Observed(const std::string& urdf, const std::string& study,
           const std::vector<SignalDescription>& signals = {}, double compliance = 0.0)
      : compiled(urdf, study, compliance), observer(compiled.system, signals) {
    EXPECT_TRUE(compiled.start().ok());
    observer.observe(compiled.state, 0.25, compiled.assembly.theta(), &compiled.equations, &frame);
  }
};

const std::string kSwing = "{hinge: {position: 0.4, velocity: 3.0}}";

TEST(Observer, ReadsAJointAndItsEffort) {
  const Observed o(pendulum(),
                   let_go(kSwing, "hinge/velocity",
                          "controllers: {hold: {type: pid, input: hinge/position, setpoint: 1.0, "
                          "output: hinge, gains: {p: 5.0}}}\n"),
                   {parse_signal("hinge/velocity - hold/error", {}, "signal")});
  EXPECT_EQ(o.observer.names().joints, std::vector<std::string>{"hinge"});
  const JointSample& joint = o.frame.joints.at(0);
  EXPECT_NEAR(joint.position, 0.4, 1e-14);
  EXPECT_NEAR(joint.velocity, 3.0, 1e-13);
  EXPECT_NEAR(joint.effort, 5.0 * 0.6, 1e-13);
  EXPECT_NEAR(joint.acceleration, (3.0 - 9.81 * 0.5 * std::sin(0.4)) / (0.0834 + 0.25), 1e-11);
  const ControllerSample& controller = o.frame.controllers.at(0);
  EXPECT_EQ(controller.setpoint, 1.0);
  EXPECT_NEAR(controller.input, 0.4, 1e-14);
  EXPECT_NEAR(controller.output, 3.0, 1e-13);
  EXPECT_NEAR(o.frame.signals.at(0), 3.0 - 0.6, 1e-13);
  EXPECT_EQ(o.frame.objective, 0.25);
}

TEST(Observer, FrictionIsATorqueAgainstTheMotion) {
  const Observed o(pendulum(pin_friction()), let_go(kSwing, "hinge/velocity"));
  ASSERT_EQ(o.observer.names().frictions, std::vector<std::string>{"hinge"});
  EXPECT_TRUE(o.observer.names().friction_is_torque[0]);
  const FrictionSample& sample = o.frame.frictions.at(0);
  EXPECT_NEAR(sample.sliding_velocity, 3.0, 1e-13);
  EXPECT_GT(sample.normal_force, 0.0);
  EXPECT_LT(sample.friction, 0.0);
  EXPECT_NEAR(sample.torque.y(), sample.friction, 1e-14) << "about the hinge's axis";
  EXPECT_EQ(sample.force.norm(), 0.0);
  EXPECT_LT(sample.position.norm(), 1e-14);
  // Balance of moments: inertia times acceleration minus the moment of gravity is the friction.
  const double moment =
      (0.0834 + 0.25) * o.frame.joints[0].acceleration + 9.81 * 0.5 * std::sin(0.4);
  EXPECT_NEAR(moment, sample.friction, 1e-11);
}

TEST(Observer, LinksAndLoopJointsAreSeenToo) {
  const Observed o(four_bar(), let_go("{left_hinge: {position: 0.6}}", "left_hinge/velocity"), {},
                   1e-9);
  const FrameNames& names = o.observer.names();
  EXPECT_EQ(names.joints,
            (std::vector<std::string>{"left_hinge", "right_hinge", "left_pin", "right_pin"}));
  EXPECT_EQ(names.tree_joints, 3U);
  EXPECT_EQ(names.loops, std::vector<std::string>{"right_pin"});
  ASSERT_EQ(o.frame.loop_errors.size(), 1U);
  EXPECT_LT(o.frame.loop_errors[0], 1e-13);
  // The right bar's tip is where the coupler ends: 1.2 further along its own -z.
  const LinkSample &right = o.frame.links.at(2), &coupler = o.frame.links.at(3);
  const Eigen::Vector3d tip = right.position - right.orientation * Eigen::Vector3d::UnitZ();
  EXPECT_LT(
      (coupler.position - 1.2 * (coupler.orientation * Eigen::Vector3d::UnitZ()) - tip).norm(),
      1e-12);
}

TEST(Observer, AJointThatMovesNoMassStaysWhereItStarted) {
  const std::string urdf =
      robot(bar("bar") + hinge("hinge", "ground", "bar", "0 0 0") + "<link name='finger'/>" +
            hinge("grip", "bar", "finger", "0 0 -1"));
  const Observed o(urdf,
                   let_go("{hinge: {position: 0.4}, grip: {position: 0.3}}", "hinge/velocity"));
  EXPECT_EQ(o.observer.names().joints, (std::vector<std::string>{"hinge", "grip"}));
  EXPECT_EQ(o.frame.joints.at(1).position, 0.3);
  const double turn = 2.0 * std::acos(o.frame.links.at(2).orientation.w());
  EXPECT_NEAR(turn, 0.7, 1e-12);
  EXPECT_LT((o.frame.links[2].position + Eigen::Vector3d(std::sin(0.4), 0.0, std::cos(0.4))).norm(),
            1e-14);
}

// theta of the observer has planar and floating joints at their start positions only.
TEST(Observer, ALinkWithoutMassBelowAFreeJointGoesWithIt) {
  for (const char* type : {"floating", "planar"}) {
    const std::string urdf = robot(bar("bar") + "<joint name='free' type='" + type +
                                   "'><parent link='ground'/><child link='bar'/><axis xyz='0 1 "
                                   "0'/></joint><link name='finger'/>" +
                                   hinge("grip", "bar", "finger", "0 0 -1") + "<link name='tip'/>" +
                                   hinge("tip_joint", "finger", "tip", "0 0 -0.5"));
    Observed o(urdf, let_go("{grip: {position: 0.3}}", "bar/position/z"));
    // Half a metre along z, and a turn of 0.8 rad about y, the hinges' axis.
    State<double> moved = o.compiled.state;
    const double half = 0.4;
    const Eigen::Vector3d centre = moved.q.head<3>();
    moved.q.segment<4>(3) = Eigen::Vector4d(std::cos(half), 0.0, std::sin(half), 0.0);
    const Eigen::Matrix3d R =
        Eigen::AngleAxisd(2.0 * half, Eigen::Vector3d::UnitY()).toRotationMatrix();
    moved.q.head<3>() = R * centre + 0.5 * Eigen::Vector3d::UnitZ();
    o.observer.observe(moved, 0.0, o.compiled.assembly.theta(), &o.compiled.equations, &o.frame);
    const LinkSample &bar = o.frame.links.at(1), &finger = o.frame.links.at(2),
                     &tip = o.frame.links.at(3);
    EXPECT_LT((bar.position - Eigen::Vector3d(0.0, 0.0, 0.5)).norm(), 1e-12) << type;
    EXPECT_LT((finger.position - (Eigen::Vector3d(0.0, 0.0, 0.5) - R.col(2))).norm(), 1e-12)
        << type;
    EXPECT_NEAR(finger.orientation.angularDistance(bar.orientation), 0.3, 1e-12) << type;
    EXPECT_LT(
        (tip.position - (finger.position - 0.5 * (finger.orientation * Eigen::Vector3d::UnitZ())))
            .norm(),
        1e-12)
        << type;
  }
}

TEST(Observer, ASignalMustExist) {
  const Compiled c(pendulum(), let_go("{}", "hinge/velocity"));
  EXPECT_THROW(Observer(c.system, {parse_signal("hing/velocity", {}, "signal")}), InputError);
}

}  // namespace
}  // namespace codesign
