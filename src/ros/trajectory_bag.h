// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "description/reference.h"
#include "ros/inputs.h"

namespace codesign {

/// A loader that reads the way-points of one joint from a bag: from the one trajectory_msgs/JointTrajectory of a topic that names the
/// joint. Fails with an InputError if there is none, or more than one.
/// @param folder base of relative bag paths; empty: only absolute paths are accepted.
TrajectoryLoader bag_trajectory_loader(const std::string& folder);

/// The folder of a node's study file; empty for a study on the parameter server.
std::string study_folder(const Inputs& inputs);

}  // namespace codesign
