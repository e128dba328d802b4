// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <rosbag/bag.h>
#include <rosbag/view.h>
#include <std_msgs/String.h>
#include <trajectory_msgs/JointTrajectory.h>

#include <fstream>
#include <sstream>

#include "fuzz/damage.h"
#include "integration/simulation_of.h"
#include "jobs/files.h"
#include "mechanism_codesign/simulation.h"
#include "problem/load_problem.h"
#include "ros/bags/bag_files.h"
#include "ros/pendulum.h"
#include "temporary_directory.h"

namespace codesign {
namespace {

/// A bag with a trajectory of two joints on `arm`, one without velocities, two for one joint on
/// `twice`, and a text on `words`.
class TrajectoryBag : public testing::Test {
 protected:
  TrajectoryBag() {
    rosbag::Bag bag((directory_.path() / "moves.bag").string(), rosbag::bagmode::Write);
    trajectory_msgs::JointTrajectory message;
    message.joint_names = {"elbow", "hinge"};
    for (int k = 0; k < 3; ++k) {
      trajectory_msgs::JointTrajectoryPoint point;
      point.time_from_start = ros::Duration(0.25 * k);
      point.positions = {9.0, 0.5 + 0.1 * k};
      point.velocities = {9.0, 0.01 * k};
      message.points.push_back(point);
    }
    const ros::Time time(1.0);
    bag.write("arm", time, message);
    bag.write("twice", time, message);
    bag.write("twice", time, message);
    bag.write("words", time, std_msgs::String());
    message.points[1].velocities.clear();
    bag.write("gaps", time, message);
    message.points[1].positions.clear();
    bag.write("empty", time, message);
  }

  RecordedTrajectory load(const std::string& topic, const std::string& joint,
                          const std::string& bag = "moves.bag") const {
    return bag_trajectory_loader(directory_.path().string())(
        {bag, topic, joint, {"study.yaml", 4}, "setpoint"});
  }
  InputFault fault(const std::string& topic, const std::string& joint,
                   const std::string& bag = "moves.bag") const {
    try {
      load(topic, joint, bag);
    } catch (const InputError& error) {
      EXPECT_EQ(error.fault().where.line, 4);
      return error.fault();
    }
    ADD_FAILURE() << "accepted";
    return {};
  }

  TemporaryDirectory directory_;
};

TEST_F(TrajectoryBag, GivesTheWaypointsOfOneJoint) {
  const RecordedTrajectory trajectory = load("arm", "hinge");
  EXPECT_EQ(trajectory.times, (std::vector<double>{0.0, 0.25, 0.5}));
  EXPECT_EQ(trajectory.positions, (std::vector<double>{0.5, 0.6, 0.7}));
  EXPECT_EQ(trajectory.velocities, (std::vector<double>{0.0, 0.01, 0.02}));
  EXPECT_TRUE(trajectory.accelerations.empty());
  EXPECT_TRUE(load("gaps", "hinge").velocities.empty());
}

TEST_F(TrajectoryBag, WhatIsNotThereIsSaid) {
  EXPECT_NE(fault("arm", "wrist").message.find("no trajectory on this topic names the joint"),
            std::string::npos);
  EXPECT_EQ(fault("arm", "wrist").element, "setpoint.joint");
  EXPECT_NE(fault("leg", "hinge").message.find("no message on this topic"), std::string::npos);
  EXPECT_NE(fault("words", "hinge").message.find("std_msgs/String"), std::string::npos);
  EXPECT_NE(fault("twice", "hinge").message.find("2 trajectories name the joint"),
            std::string::npos);
  EXPECT_NE(fault("empty", "hinge").message.find("no positions"), std::string::npos);
  EXPECT_NE(fault("arm", "hinge", "lost.bag").message.find("cannot be read"), std::string::npos);
}

TEST_F(TrajectoryBag, OfAnyBytesIsReadOrRefused) {
  const std::string path = (directory_.path() / "moves.bag").string();
  std::ostringstream whole;
  whole << std::ifstream(path, std::ios::binary).rdbuf();
  fuzz::Dice dice(24);
  for (int k = 0; k < 120; ++k) {
    std::ofstream(path, std::ios::binary) << fuzz::damage(whole.str(), &dice);
    try {
      load("arm", "hinge");
    } catch (const InputError& error) {
      EXPECT_EQ(error.fault().element.rfind("setpoint", 0), 0U);
    }
  }
}

TEST_F(TrajectoryBag, ARelativePathNeedsAFolder) {
  const TrajectoryLoader loader = bag_trajectory_loader("");
  EXPECT_THROW(loader({"moves.bag", "arm", "hinge", {}, ""}), InputError);
  EXPECT_EQ(
      loader({(directory_.path() / "moves.bag").string(), "arm", "hinge", {}, ""}).times.size(),
      3U);
}

TEST_F(TrajectoryBag, AStudyFollowsIt) {
  std::string study = kPendulumStudy;
  study.replace(study.find("setpoint: 0.0"), 13,
                "setpoint: {type: trajectory, bag: moves.bag, topic: arm, joint: hinge}");
  const Problem problem =
      load_problem({"pendulum.urdf", kPendulumUrdf}, {}, {"pendulum.yaml", study}, {},
                   bag_trajectory_loader(directory_.path().string()));
  Simulation simulation = simulation_of(system_of(problem), problem.parameters());
  std::vector<double> setpoints;
  simulate(&simulation, 0.5, 3, [&setpoints](const Frame& frame) {
    setpoints.push_back(frame.controllers.at(0).setpoint);
    return true;
  });
  ASSERT_EQ(setpoints.size(), 3U);
  EXPECT_NEAR(setpoints[0], 0.5, 1e-12);
  EXPECT_NEAR(setpoints[1], 0.6, 1e-12);
  EXPECT_NEAR(setpoints[2], 0.7, 1e-12);
}

TrajectoryPoints some_points() {
  TrajectoryPoints points;
  points.joints = {"shoulder", "elbow"};
  points.times = {0.0, 0.01, 0.02};
  points.position = (Eigen::MatrixXd(2, 3) << 0.1, 0.2, 0.3, 1.1, 1.2, 1.3).finished();
  points.velocity = 2.0 * points.position;
  points.acceleration = 3.0 * points.position;
  points.effort = 4.0 * points.position;
  return points;
}

TEST(JointTrajectoryBag, IsReadBack) {
  const TemporaryDirectory directory;
  const std::string path = (directory.path() / "trajectory.bag").string();
  write_joint_trajectory_bag(path, some_points());
  write_joint_trajectory_bag(path, some_points());  // replaces the first one
  rosbag::Bag bag(path);
  rosbag::View view(bag);
  ASSERT_EQ(view.size(), 1U);
  const auto message = view.begin()->instantiate<trajectory_msgs::JointTrajectory>();
  ASSERT_TRUE(message);
  EXPECT_EQ(view.begin()->getTopic(), kTrajectoryTopic);
  EXPECT_TRUE(message->header.stamp.isZero());
  EXPECT_EQ(message->joint_names, (std::vector<std::string>{"shoulder", "elbow"}));
  ASSERT_EQ(message->points.size(), 3U);
  EXPECT_EQ(message->points[1].positions, (std::vector<double>{0.2, 1.2}));
  EXPECT_EQ(message->points[1].velocities, (std::vector<double>{0.4, 2.4}));
  EXPECT_EQ(message->points[2].accelerations[1], 3.0 * 1.3);
  EXPECT_EQ(message->points[2].effort[0], 4.0 * 0.3);
  EXPECT_EQ(message->points[2].time_from_start, ros::Duration(0.02));
}

TEST(JointTrajectoryBag, IsAReferenceOfAStudy) {
  const TemporaryDirectory directory;
  write_joint_trajectory_bag((directory.path() / "trajectory.bag").string(), some_points());
  const RecordedTrajectory trajectory = bag_trajectory_loader(directory.path().string())(
      {"trajectory.bag", kTrajectoryTopic, "elbow", {"study.yaml", 4}, "setpoint"});
  EXPECT_EQ(trajectory.times, (std::vector<double>{0.0, 0.01, 0.02}));
  EXPECT_EQ(trajectory.positions, (std::vector<double>{1.1, 1.2, 1.3}));
}

TEST(JointTrajectoryBag, AFolderThatIsMissingIsAnOutputError) {
  EXPECT_THROW(write_joint_trajectory_bag("/nowhere/at/all/trajectory.bag", some_points()),
               OutputError);
}

}  // namespace
}  // namespace codesign
