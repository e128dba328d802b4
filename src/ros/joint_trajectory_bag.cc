// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "ros/joint_trajectory_bag.h"

#include <trajectory_msgs/JointTrajectory.h>
#include <unistd.h>

#include <cerrno>

#include "jobs/files.h"
#include "ros/bag_file.h"

namespace codesign {
namespace {

std::vector<double> column_at(const Eigen::MatrixXd& matrix, Eigen::Index column) {
  const auto entries = matrix.col(column);
  return {entries.begin(), entries.end()};
}

void remove_if_there(const std::string& path) {
  if (unlink(path.c_str()) != 0 && errno != ENOENT) throw OutputError::of_system(path, errno);
}

}  // namespace

void write_joint_trajectory_bag(const std::string& path, const TrajectoryPoints& points) {
  trajectory_msgs::JointTrajectory message;
  message.joint_names = points.joints;
  for (std::size_t k = 0; k < points.times.size(); ++k) {
    const auto column = static_cast<Eigen::Index>(k);
    trajectory_msgs::JointTrajectoryPoint point;
    point.positions = column_at(points.position, column);
    point.velocities = column_at(points.velocity, column);
    point.accelerations = column_at(points.acceleration, column);
    point.effort = column_at(points.effort, column);
    point.time_from_start = ros::Duration(points.times[k]);
    message.points.push_back(std::move(point));
  }
  remove_if_there(path);
  remove_if_there(path + ".active");
  BagFile bag(path);
  bag.write(kTrajectoryTopic, ros::TIME_MIN, message);
  bag.finish();
}

}  // namespace codesign
