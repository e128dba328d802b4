// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "ros/trajectory_bag.h"

#include <rosbag/bag.h>
#include <rosbag/view.h>
#include <trajectory_msgs/JointTrajectory.h>

#include <algorithm>
#include <filesystem>
#include <vector>

#include "description/named_file.h"

namespace codesign {
namespace {

[[noreturn]] void fail(const TrajectoryAddress& address, const std::string& key, const std::string& message, const std::string& value,
                       const std::string& allowed) {
  throw InputError({address.where, address.element + "." + key, message, value, allowed});
}

std::size_t index_of(const trajectory_msgs::JointTrajectory& message, const std::string& joint) {
  const auto& names = message.joint_names;
  return static_cast<std::size_t>(std::find(names.begin(), names.end(), joint) - names.begin());
}

trajectory_msgs::JointTrajectory find_message(const TrajectoryAddress& address, const std::string& path) {
  std::vector<trajectory_msgs::JointTrajectory::ConstPtr> found;
  bool any = false;
  rosbag::Bag bag(path);
  rosbag::View view(bag, rosbag::TopicQuery(address.topic));
  for (const rosbag::MessageInstance& instance : view) {
    any = true;
    const auto message = instance.instantiate<trajectory_msgs::JointTrajectory>();
    if (!message)
      fail(address, "topic", "the topic does not hold trajectories but " + instance.getDataType(), address.topic,
           "trajectory_msgs/JointTrajectory");
    if (index_of(*message, address.joint) < message->joint_names.size()) found.push_back(message);
  }
  if (!any) fail(address, "topic", "the bag holds no message on this topic", address.topic, "");
  if (found.empty()) fail(address, "joint", "no trajectory on this topic names the joint", address.joint, "");
  if (found.size() > 1)
    fail(address, "topic", std::to_string(found.size()) + " trajectories name the joint", address.topic, "one; rosbag filter keeps one");
  return *found.front();
}

/// The entries of one joint at all points; empty if the points do not have this field.
std::vector<double> column(const trajectory_msgs::JointTrajectory& message, std::size_t joint,
                           std::vector<double> trajectory_msgs::JointTrajectoryPoint::*member) {
  std::vector<double> values;
  for (const trajectory_msgs::JointTrajectoryPoint& point : message.points)
    if (joint < (point.*member).size()) values.push_back((point.*member)[joint]);
  return values.size() == message.points.size() ? values : std::vector<double>();
}

RecordedTrajectory load(const TrajectoryAddress& address, const std::string& path) {
  using Point = trajectory_msgs::JointTrajectoryPoint;
  const trajectory_msgs::JointTrajectory message = find_message(address, path);
  const std::size_t joint = index_of(message, address.joint);
  RecordedTrajectory trajectory{{},
                                column(message, joint, &Point::positions),
                                column(message, joint, &Point::velocities),
                                column(message, joint, &Point::accelerations)};
  for (const Point& point : message.points) trajectory.times.push_back(point.time_from_start.toSec());
  if (trajectory.positions.empty()) fail(address, "topic", "the trajectory has no positions", address.topic, "one in each point");
  return trajectory;
}

}  // namespace

TrajectoryLoader bag_trajectory_loader(const std::string& folder) {
  return [folder](const TrajectoryAddress& address) {
    const std::string path = path_of({address.bag, address.where, address.element + ".bag"}, folder);
    try {
      return load(address, path);
    } catch (const rosbag::BagException& error) {
      fail(address, "bag", std::string("the bag cannot be read: ") + error.what(), path, "");
    }
  };
}

std::string study_folder(const Inputs& inputs) {
  if (inputs.study_is_tree) return "";
  return std::filesystem::absolute(inputs.study.name).parent_path().string();
}

}  // namespace codesign
