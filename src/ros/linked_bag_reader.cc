// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "ros/joint_trajectory_bag.h"
#include "ros/recording_bag.h"

namespace codesign {

BagReader linked_bag_reader() { return read_recording_bag; }

TrajectoryBagWriter linked_trajectory_writer() { return write_joint_trajectory_bag; }

}  // namespace codesign
