// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "excitation/trajectory_basis.h"

namespace codesign {

/// The topic of the message.
inline constexpr const char* kTrajectoryTopic = "joint_trajectory";

/// Writes points as one trajectory_msgs/JointTrajectory on the topic `joint_trajectory`, with velocities, accelerations and efforts; the
/// stamp of its header is zero, which controllers take as "now". @throws OutputError. An existing file is replaced.
void write_joint_trajectory_bag(const std::string& path, const TrajectoryPoints& points);

}  // namespace codesign
