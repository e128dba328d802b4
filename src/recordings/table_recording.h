// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "description/identification.h"
#include "recordings/joint_recording.h"

namespace codesign {

/// Reads a table of numbers without checking their values. Without `columns` in the description, the columns named `time` (or `t`) and
/// `JOINT/position`, `JOINT/velocity`, `JOINT/effort` are read.
/// @param path of the file, at most 2 GB. @param joints known names of joints.
/// @throws InputError for a file that cannot be read, a missing column, or a cell that is not a number.
JointRecording read_table_recording(const RecordingDescription& description, const std::string& path,
                                    const std::vector<std::string>& joints);

}  // namespace codesign
