// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "excitation/trajectory_basis.h"
#include "jobs/identification_records.h"
#include "recordings/joint_recording.h"

namespace codesign {

/// The functions by which the program `codesign` reads and writes bags. Without ROS they are empty.
struct BagFiles {
  BagReader read;
  IdentificationBagWriter write_identification;
  TrajectoryBagWriter write_trajectory;
};

/// The functions that the program is linked with: from ros/loaded_bag_files.cc if ROS was found,
/// else from cli/no_bag_files.cc. It is not in this library.
BagFiles bag_files();

}  // namespace codesign
