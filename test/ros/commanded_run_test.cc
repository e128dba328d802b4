// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "ros/commanded_run.h"

#include <gtest/gtest.h>

#include "ros/servo_arm.h"

namespace codesign {
namespace {

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
  static TrajectoryCommand course(const std::string& joint, TrajectoryFollower follower, std::vector<CoursePoint> points,
                                  double begin = 0.0) {
    return {ros::Time(begin), {{joint, follower, std::move(points)}}};
  }

  InteractiveSimulation run_{*servo_arm().system(), {}, {}};
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
  go({course("shoulder", {0, false}, {{0.2, 2.0, {}, {}}}), course("elbow", {1, true}, {{0.2, 2.0, {}, {}}})}, 0.1);
  const double position = frame_.joints[0].position;
  go({course("shoulder", {0, false}, {}), course("elbow", {1, true}, {})}, 0.4);
  EXPECT_EQ(frame_.controllers[0].setpoint, position);
  EXPECT_EQ(frame_.controllers[1].setpoint, 0.0);
}

TEST_F(CommandedArm, OfSeveralCommandsTheLastOneCounts) {
  go({SetpointCommand{0, 0.3}, SetpointCommand{0, 0.5}, EffortCommand{{{0, 1.0}}}, EffortCommand{{{0, 2.0}}}}, 0.02);
  EXPECT_EQ(frame_.controllers[0].setpoint, 0.5);
  EXPECT_EQ(run_.effort(0), 2.0);
  commanded_.clear();
  ASSERT_TRUE(run_.start(run_.parameters()).ok());
  EXPECT_EQ(run_.effort(0), 0.0);
}

}  // namespace
}  // namespace codesign
