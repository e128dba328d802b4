// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "ros/identification_bag.h"
#include "ros/joint_trajectory_bag.h"
#include "ros/recording_bag.h"

namespace codesign {

BagReader linked_bag_reader() { return read_recording_bag; }

IdentificationBagWriter linked_identification_bag() {
  return [](const std::string& path, const IdentificationShow& show) { write_identification_bag(path, show, nullptr); };
}

TrajectoryBagWriter linked_trajectory_writer() { return write_joint_trajectory_bag; }

}  // namespace codesign
