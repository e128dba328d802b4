// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "ros/joint_trajectory_bag.h"

#include <gtest/gtest.h>
#include <rosbag/bag.h>
#include <rosbag/view.h>
#include <trajectory_msgs/JointTrajectory.h>

#include "jobs/files.h"
#include "ros/trajectory_bag.h"
#include "temporary_directory.h"

namespace codesign {
namespace {

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
  const RecordedTrajectory trajectory =
      bag_trajectory_loader(directory.path().string())({"trajectory.bag", kTrajectoryTopic, "elbow", {"study.yaml", 4}, "setpoint"});
  EXPECT_EQ(trajectory.times, (std::vector<double>{0.0, 0.01, 0.02}));
  EXPECT_EQ(trajectory.positions, (std::vector<double>{1.1, 1.2, 1.3}));
}

TEST(JointTrajectoryBag, AFolderThatIsMissingIsAnOutputError) {
  EXPECT_THROW(write_joint_trajectory_bag("/nowhere/at/all/trajectory.bag", some_points()), OutputError);
}

}  // namespace
}  // namespace codesign
