// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "description/identification.h"
#include "description/robot.h"
#include "mechanism_codesign/warning.h"
#include "recordings/bag_reader.h"
#include "recordings/joint_recording.h"

namespace codesign {

/// The recordings of a study.
struct StudyRecordings {
  std::vector<JointRecording> data, holdout;
};

/// Reads and checks the recordings that a study names: checked_part(), unwrap_turns(), check_units(), even_stamps(), without_gaps(). Each
/// recording must have all joints of `identify.joints`.
/// @param folder base of relative paths; empty: only absolute paths are accepted.
/// @param reader reads bags; if it is empty, a study that names a bag is refused.
/// @throws InputError with the place in the study or in the file.
StudyRecordings load_recordings(const IdentificationDescription& identification, const RobotDescription& robot, const std::string& folder,
                                const BagReader& reader, Warnings* warnings);

}  // namespace codesign
