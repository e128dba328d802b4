// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <functional>
#include <string>
#include <vector>

namespace codesign {

/// The motion of several joints at given times, with the expected efforts; in the joints' units, joints x times.
struct TrajectoryPoints {
  std::vector<std::string> joints;
  std::vector<double> times;  ///< ascending from 0 [s]
  Eigen::MatrixXd position, velocity, acceleration, effort;
};

/// Callback that writes points as one trajectory_msgs/JointTrajectory into a bag. The caller provides it, since this library does not
/// depend on ROS. @throws OutputError if the bag cannot be written. An existing file is replaced.
using TrajectoryBagWriter = std::function<void(const std::string& path, const TrajectoryPoints& points)>;

}  // namespace codesign
