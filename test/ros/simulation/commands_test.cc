// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "ros/simulation/commands.h"

#include <gtest/gtest.h>

#include <limits>

#include "problem/load_problem.h"
#include "ros/servo_arm.h"

namespace codesign {
namespace {

const CommandInputs& arm_inputs() {
  static const CommandInputs kInputs(*system_of(servo_arm()), {});
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
  for (const char* const part : parts)
    EXPECT_NE(said.find(part), std::string::npos) << part << " in: " << said;
}

sensor_msgs::JointState efforts(const std::vector<std::string>& names,
                                const std::vector<double>& values) {
  sensor_msgs::JointState message;
  message.name = names;
  message.effort = values;
  return message;
}

trajectory_msgs::JointTrajectory trajectory(const std::vector<std::string>& joints,
                                            const std::vector<double>& times) {
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
  expect_refused(refusal_of([&] { read_efforts(arm_inputs(), "efforts", message); }),
                 {"efforts", "wrong number", "1", "shoulder, elbow"});
}

TEST(CommandReading, ARefusedEffortNamesTopicJointAndValue) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto read = [](const sensor_msgs::JointState& message) {
    return refusal_of([&] { read_efforts(arm_inputs(), "/s/effort", message); });
  };
  expect_refused(read(efforts({"elbo"}, {1.0})),
                 {"/s/effort", "unknown joint", "did you mean \"elbow\""});
  expect_refused(read(efforts({"elbow"}, {nan})), {"/s/effort", "elbow", "finite", "nan"});
  expect_refused(read(efforts({"elbow", "shoulder"}, {1.0})), {"wrong number of values", "2"});
  expect_refused(read(efforts({"elbow", "elbow"}, {1.0, 1.0})), {"named twice"});
  expect_refused(read(efforts({}, {})), {"no joint is named"});
}

TEST(CommandReading, AnEffortOnAGivenMotionIsRefused) {
  const Problem arm = servo_arm();
  const Problem problem = load_problem(
      arm.urdf(), {},
      {"arm.yaml",
       "duration: 1.0\nmotion: {shoulder: {velocity: 0.5}}\nobjective: {integral: [{signal: "
       "elbow/position}]}\n"});
  const CommandInputs inputs(*system_of(problem), {});
  EXPECT_EQ(read_efforts(inputs, "effort", efforts({"elbow"}, {1.0})).efforts.at(0).first, 0U);
  expect_refused(
      refusal_of([&] { read_efforts(inputs, "/s/effort", efforts({"shoulder"}, {1.0})); }),
      {"/s/effort", "shoulder", "gives the motion of the joint", "allowed: elbow"});
}

TEST(CommandReading, ASetPointIsAFiniteNumber) {
  std_msgs::Float64 message;
  message.data = 0.7;
  EXPECT_EQ(read_setpoint(arm_inputs(), "hold/command", 0, message).value, 0.7);
  message.data = std::numeric_limits<double>::infinity();
  expect_refused(refusal_of([&] { read_setpoint(arm_inputs(), "/hold/command", 0, message); }),
                 {"/hold/command", "hold", "inf"});
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
  expect_refused(read(trajectory({"elbow"}, {0.5, 0.5})),
                 {"points[1].time_from_start", "ascend", "0.5"});
  expect_refused(read(trajectory({"elbow"}, {-0.5})), {"points[0].time_from_start", "-0.5"});
  trajectory_msgs::JointTrajectory message = trajectory({"elbow"}, {0.5});
  message.points[0].velocities = {1.0, 2.0};
  expect_refused(read(message), {"points[0].velocities", "wrong number", "2"});
  message.points[0].velocities = {std::numeric_limits<double>::quiet_NaN()};
  expect_refused(read(message), {"elbow, points[0].velocities", "nan"});
  message.points[0].positions.clear();
  expect_refused(read(message), {"points[0].positions", "0"});
}

class CommandedArm : public testing::Test {
 protected:
  void SetUp() override { ASSERT_TRUE(run_.start(run_.parameters()).ok()); }

  /// Applies commands at the present instant and goes on to `time`.
  bool go(const std::vector<Command>& commands, double time) {
    run_.sample(now_, &frame_);
    const CommandedRun::Outcome outcome = commanded_.apply(commands, frame_, clock_);
    EXPECT_TRUE(outcome.status.ok()) << outcome.status.cause;
    EXPECT_TRUE(run_.advance(time).ok());
    run_.sample(time, &frame_);
    now_ = time;
    return outcome.changed;
  }
  static TrajectoryCommand course(const std::string& joint, TrajectoryFollower follower,
                                  std::vector<CoursePoint> points, double begin = 0.0) {
    return {ros::Time(begin), {{joint, follower, std::move(points)}}};
  }

  InteractiveSimulation run_{*system_of(servo_arm()), {}, {}};
  CommandedRun commanded_{&run_, 0.1};
  RunClock clock_{0.0};
  Frame frame_;
  double now_ = 0.0;
};

TEST_F(CommandedArm, EffortsHoldUntilTheTimeoutAndSetPointsBeyondIt) {
  EXPECT_FALSE(go({}, 0.05));
  EXPECT_TRUE(go({EffortCommand{{{1, 3.0}}}, SetpointCommand{0, 0.6}}, 0.1));
  EXPECT_EQ(commanded_.message(0.1).efforts, (std::vector<double>{0.0, 3.0}));
  EXPECT_FALSE(go({}, 0.14));
  EXPECT_FALSE(go({}, 0.15));
  EXPECT_FALSE(commanded_.is_timed_out());
  EXPECT_TRUE(go({}, 0.2));
  EXPECT_TRUE(commanded_.is_timed_out());
  const mechanism_codesign::Commands message = commanded_.message(0.2);
  EXPECT_EQ(message.efforts, (std::vector<double>{0.0, 0.0}));
  EXPECT_EQ(message.controllers, std::vector<std::string>{"hold"});
  EXPECT_EQ(message.setpoints, std::vector<double>{0.6});
  EXPECT_FALSE(go({}, 0.4)) << "told once";
  EXPECT_TRUE(go({EffortCommand{{{0, 1.0}}}}, 0.41));
  EXPECT_FALSE(commanded_.is_timed_out());
}

TEST_F(CommandedArm, ATrajectoryBeginsAtTheSetPointAndIsFollowed) {
  go({}, 0.1);
  go({course("shoulder", {0, false}, {{0.2, 0.6, {}, {}}})}, 0.2);
  EXPECT_NEAR(frame_.controllers[0].setpoint, 0.4, 1e-12);
  go({}, 0.9);
  EXPECT_EQ(frame_.controllers[0].setpoint, 0.6);
  EXPECT_NEAR(frame_.joints[0].position, 0.6, 0.15);
}

TEST_F(CommandedArm, TheRateOfATrajectoryIsTheSetPointOfAVelocity) {
  go({course("elbow", {1, true}, {{0.0, 0.1, {}, {}}, {0.5, 1.1, {}, {}}})}, 0.3);
  EXPECT_NEAR(frame_.controllers[1].setpoint, 2.0, 1e-12);
  go({}, 0.7);
  EXPECT_EQ(frame_.controllers[1].setpoint, 0.0);
}

TEST_F(CommandedArm, AStampSaysWhenATrajectoryBegins) {
  // The free clock starts at one second.
  go({course("shoulder", {0, false}, {{0.1, 1.2, {}, {}}}, 1.3)}, 0.25);
  EXPECT_EQ(frame_.controllers[0].setpoint, 0.2) << "the study's until then";
  go({}, 0.35);
  EXPECT_NEAR(frame_.controllers[0].setpoint, 0.7, 1e-9);
  go({course("shoulder", {0, false}, {{0.0, 0.0, {}, {}}, {0.4, 4.0, {}, {}}}, 1.2)}, 0.45);
  EXPECT_NEAR(frame_.controllers[0].setpoint, 2.5, 1e-9) << "what is past is left out";
}

TEST_F(CommandedArm, AnEmptyTrajectoryHoldsTheJointWhereItIs) {
  go({course("shoulder", {0, false}, {{0.2, 2.0, {}, {}}}),
      course("elbow", {1, true}, {{0.2, 2.0, {}, {}}})},
     0.1);
  const double position = frame_.joints[0].position;
  go({course("shoulder", {0, false}, {}), course("elbow", {1, true}, {})}, 0.4);
  EXPECT_EQ(frame_.controllers[0].setpoint, position);
  EXPECT_EQ(frame_.controllers[1].setpoint, 0.0);
}

TEST_F(CommandedArm, OfSeveralCommandsTheLastOneCounts) {
  go({SetpointCommand{0, 0.3}, SetpointCommand{0, 0.5}, EffortCommand{{{0, 1.0}}},
      EffortCommand{{{0, 2.0}}}},
     0.02);
  EXPECT_EQ(frame_.controllers[0].setpoint, 0.5);
  EXPECT_EQ(run_.effort(0), 2.0);
  commanded_.clear();
  ASSERT_TRUE(run_.start(run_.parameters()).ok());
  EXPECT_EQ(run_.effort(0), 0.0);
}

}  // namespace
}  // namespace codesign
