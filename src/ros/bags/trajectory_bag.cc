// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include <trajectory_msgs/JointTrajectory.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <filesystem>
#include <new>
#include <utility>
#include <vector>

#include "description/named_file.h"
#include "jobs/files.h"
#include "math/arrays.h"
#include "ros/bags/bag_contents.h"
#include "ros/bags/bag_files.h"
#include "ros/bags/bag_writer.h"
#include "ros/bags/job_bag.h"

namespace codesign {
namespace {

[[noreturn]] void fail(const TrajectoryAddress& address, const std::string& key,
                       const std::string& message, const std::string& value,
                       const std::string& allowed) {
  throw InputError({address.where, address.element + "." + key, message, value, allowed});
}

struct Point {
  std::vector<double> positions, velocities, accelerations, effort;
  double time = 0.0;  ///< [s]
};

/// A message of type trajectory_msgs/JointTrajectory.
struct Trajectory {
  std::vector<std::string> joints;
  std::vector<Point> points;
};

Trajectory trajectory_of(BagCursor content) {
  Trajectory message;
  content.number<std::uint32_t>("a header's sequence number");
  content.time("a stamp");
  content.block("a frame's name");
  message.joints = content.strings("a joint's name");
  for (std::uint64_t left = content.number<std::uint32_t>("points"); left > 0; --left) {
    Point point;
    for (std::vector<double>* numbers :
         {&point.positions, &point.velocities, &point.accelerations, &point.effort})
      *numbers = content.doubles("a point's numbers");
    const double seconds = content.number<std::int32_t>("a point's time");
    point.time = seconds + 1e-9 * content.number<std::int32_t>("a point's time");
    message.points.push_back(std::move(point));
  }
  if (!content.at_end()) content.fail("a message that is longer than its arrays");
  return message;
}

std::size_t index_of(const Trajectory& message, const std::string& joint) {
  return to_index(std::find(message.joints.begin(), message.joints.end(), joint) -
                  message.joints.begin());
}

Trajectory find_message(const TrajectoryAddress& address, const std::string& path) {
  std::vector<Trajectory> found;
  bool any = false;
  BagContents(path).visit(address.topic, nullptr, [&](const BagMessage& message) {
    any = true;
    if (message.connection.md5sum !=
        ros::message_traits::md5sum<trajectory_msgs::JointTrajectory>())
      fail(address, "topic", "the topic does not hold trajectories but " + message.connection.type,
           address.topic, "trajectory_msgs/JointTrajectory");
    Trajectory trajectory = trajectory_of(message.content);
    if (index_of(trajectory, address.joint) < trajectory.joints.size())
      found.push_back(std::move(trajectory));
  });
  if (!any)
    fail(address, "topic", "the bag holds no message on this topic", address.topic,
         "a topic that rosbag info shows");
  if (found.empty())
    fail(address, "joint", "no trajectory on this topic names the joint", address.joint,
         "a name in joint_names of its messages");
  if (found.size() > 1)
    fail(address, "topic", std::to_string(found.size()) + " trajectories name the joint",
         address.topic, "one; rosbag filter keeps one");
  return std::move(found.front());
}

/// The entries of one joint at all points; empty if the points do not have this field.
std::vector<double> column(const Trajectory& message, std::size_t joint,
                           std::vector<double> Point::*member) {
  std::vector<double> values;
  for (const Point& point : message.points)
    if (joint < (point.*member).size()) values.push_back((point.*member)[joint]);
  return values.size() == message.points.size() ? values : std::vector<double>();
}

RecordedTrajectory load(const TrajectoryAddress& address, const std::string& path) {
  const Trajectory message = find_message(address, path);
  const std::size_t joint = index_of(message, address.joint);
  RecordedTrajectory trajectory{{},
                                column(message, joint, &Point::positions),
                                column(message, joint, &Point::velocities),
                                column(message, joint, &Point::accelerations)};
  for (const Point& point : message.points) trajectory.times.push_back(point.time);
  if (trajectory.positions.empty())
    fail(address, "topic", "the trajectory has no positions", address.topic, "one in each point");
  return trajectory;
}

std::vector<double> column_at(const Eigen::MatrixXd& matrix, Eigen::Index column) {
  const auto entries = matrix.col(column);
  return {entries.begin(), entries.end()};
}

void remove_if_there(const std::string& path) {
  if (unlink(path.c_str()) != 0 && errno != ENOENT) throw OutputError::of_system(path, errno);
}

}  // namespace

TrajectoryLoader bag_trajectory_loader(const std::string& folder) {
  return [folder](const TrajectoryAddress& address) {
    const std::string path =
        path_of({address.bag, address.where, address.element + ".bag"}, folder);
    try {
      return load(address, path);
    } catch (const BagFault& error) {
      fail(address, "bag", std::string("the bag cannot be read: ") + error.what(), path, "");
    } catch (const std::bad_alloc&) {
      fail(address, "bag", "the bag cannot be read: its trajectories do not fit into the memory",
           path, "");
    }
  };
}

void write_joint_trajectory_bag(const std::string& path, const TrajectoryPoints& points) {
  trajectory_msgs::JointTrajectory message;
  message.joint_names = points.joints;
  for (std::size_t k = 0; k < points.times.size(); ++k) {
    const auto column = to_signed(k);
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

const codesign::BagFiles* codesign_bag_files() {
  using codesign::IdentificationShow;
  static const codesign::BagFiles files{
      codesign::read_recording_bag,
      [](const std::string& path, const IdentificationShow& show) {
        codesign::write_identification_bag(path, show, nullptr);
      },
      codesign::write_joint_trajectory_bag};
  return &files;
}
