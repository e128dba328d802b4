// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "ros/command_reading.h"

#include <gtest/gtest.h>

#include <limits>

#include "ros/servo_arm.h"

namespace codesign {
namespace {

const CommandInputs& arm_inputs() {
  static const CommandInputs kInputs(*servo_arm().system(), {});
  return kInputs;
}

template <class Action>
std::string refusal_of(const Action& action) {
  try {
    action();
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

void expect_refused(const std::string& said, std::initializer_list<const char*> parts) {
  for (const char* const part : parts) EXPECT_NE(said.find(part), std::string::npos) << part << " in: " << said;
}

sensor_msgs::JointState efforts(const std::vector<std::string>& names, const std::vector<double>& values) {
  sensor_msgs::JointState message;
  message.name = names;
  message.effort = values;
  return message;
}

trajectory_msgs::JointTrajectory trajectory(const std::vector<std::string>& joints, const std::vector<double>& times) {
  trajectory_msgs::JointTrajectory message;
  message.joint_names = joints;
  for (double time : times) {
    message.points.emplace_back();
    message.points.back().positions.assign(joints.size(), 10.0 * time);
    message.points.back().time_from_start = ros::Duration(time);
  }
  return message;
}

TEST(CommandReading, EffortsByNameMayLeaveJointsOut) {
  const EffortCommand command = read_efforts(arm_inputs(), "effort", efforts({"elbow"}, {-2.5}));
  ASSERT_EQ(command.efforts.size(), 1U);
  EXPECT_EQ(command.efforts[0].first, 1U);
  EXPECT_EQ(command.efforts[0].second, -2.5);
}

TEST(CommandReading, EffortsInOrderNameAllJoints) {
  std_msgs::Float64MultiArray message;
  message.data = {1.0, 2.0};
  const EffortCommand command = read_efforts(arm_inputs(), "efforts", message);
  ASSERT_EQ(command.efforts.size(), 2U);
  EXPECT_EQ(command.efforts[1].second, 2.0);
  message.data = {1.0};
  expect_refused(refusal_of([&] { read_efforts(arm_inputs(), "efforts", message); }), {"efforts", "wrong number", "1", "shoulder, elbow"});
}

TEST(CommandReading, ARefusedEffortNamesTopicJointAndValue) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto read = [](const sensor_msgs::JointState& message) {
    return refusal_of([&] { read_efforts(arm_inputs(), "/s/effort", message); });
  };
  expect_refused(read(efforts({"elbo"}, {1.0})), {"/s/effort", "unknown joint", "did you mean \"elbow\""});
  expect_refused(read(efforts({"elbow"}, {nan})), {"/s/effort", "elbow", "finite", "nan"});
  expect_refused(read(efforts({"elbow", "shoulder"}, {1.0})), {"wrong number of values", "2"});
  expect_refused(read(efforts({"elbow", "elbow"}, {1.0, 1.0})), {"named twice"});
  expect_refused(read(efforts({}, {})), {"no joint is named"});
}

TEST(CommandReading, ASetPointIsAFiniteNumber) {
  std_msgs::Float64 message;
  message.data = 0.7;
  EXPECT_EQ(read_setpoint(arm_inputs(), "hold/command", 0, message).value, 0.7);
  message.data = std::numeric_limits<double>::infinity();
  expect_refused(refusal_of([&] { read_setpoint(arm_inputs(), "/hold/command", 0, message); }), {"/hold/command", "hold", "inf"});
}

TEST(CommandReading, ATrajectoryHasACourseForEachJoint) {
  trajectory_msgs::JointTrajectory message = trajectory({"elbow", "shoulder"}, {0.0, 0.5});
  message.points[1].velocities = {1.0, 2.0};
  message.header.stamp = ros::Time(7.0);
  const TrajectoryCommand command = read_trajectory(arm_inputs(), "t", message);
  EXPECT_EQ(command.begin, ros::Time(7.0));
  ASSERT_EQ(command.joints.size(), 2U);
  EXPECT_TRUE(command.joints[0].follower.by_rate);
  EXPECT_EQ(command.joints[1].follower.controller, 0U);
  ASSERT_EQ(command.joints[1].points.size(), 2U);
  EXPECT_FALSE(command.joints[1].points[0].velocity);
  EXPECT_EQ(*command.joints[1].points[1].velocity, 2.0);
  EXPECT_EQ(command.joints[1].points[1].position, 5.0);
}

TEST(CommandReading, AnEmptyTrajectoryConcernsEveryJointThatFollows) {
  EXPECT_EQ(read_trajectory(arm_inputs(), "t", {}).joints.size(), 2U);
  const TrajectoryCommand one = read_trajectory(arm_inputs(), "t", trajectory({"elbow"}, {}));
  ASSERT_EQ(one.joints.size(), 1U);
  EXPECT_TRUE(one.joints[0].points.empty());
}

TEST(CommandReading, ARefusedTrajectoryNamesPointAndFault) {
  const auto read = [](const trajectory_msgs::JointTrajectory& message) {
    return refusal_of([&] { read_trajectory(arm_inputs(), "/t", message); });
  };
  expect_refused(read(trajectory({"wrist"}, {0.5})), {"/t", "wrist", "no controller"});
  expect_refused(read(trajectory({"elbow", "elbow"}, {0.5})), {"twice"});
  expect_refused(read(trajectory({}, {0.5})), {"no joint is named"});
  expect_refused(read(trajectory({"elbow"}, {0.5, 0.5})), {"points[1].time_from_start", "ascend", "0.5"});
  expect_refused(read(trajectory({"elbow"}, {-0.5})), {"points[0].time_from_start", "-0.5"});
  trajectory_msgs::JointTrajectory message = trajectory({"elbow"}, {0.5});
  message.points[0].velocities = {1.0, 2.0};
  expect_refused(read(message), {"points[0].velocities", "wrong number", "2"});
  message.points[0].velocities = {std::numeric_limits<double>::quiet_NaN()};
  expect_refused(read(message), {"elbow, points[0].velocities", "nan"});
  message.points[0].positions.clear();
  expect_refused(read(message), {"points[0].positions", "0"});
}

}  // namespace
}  // namespace codesign
