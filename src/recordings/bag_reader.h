// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "mechanism_codesign/warning.h"
#include "recordings/joint_recording.h"

namespace codesign {

/// Callback that reads the joint states of a topic from a bag. The caller provides it, since this library does not depend on ROS, which
/// reads bags.
/// @param path of the bag. @param joints names of the model's joints with one coordinate; other joints in the messages are ignored.
/// @throws InputError if the bag or topic cannot be read, or names none of the joints.
using BagReader = std::function<JointRecording(const RecordingDescription& description, const std::string& path,
                                               const std::vector<std::string>& joints, Warnings* warnings)>;

}  // namespace codesign
