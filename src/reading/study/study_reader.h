// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_READING_STUDY_STUDY_READER_H_
#define MECHANISM_CODESIGN_READING_STUDY_STUDY_READER_H_

#include "description/robot.h"
#include "description/study.h"
#include "reading/urdf/urdf_reader.h"

namespace codesign {

/// Reads a study (YAML) strictly: an unknown, missing or repeated key is an error that names its path.
/// The robot supplies parameter defaults and the names that may be referred to.
/// @param loader reads trajectories that the study names in a bag; without one they are refused.
/// @throws InputError naming file, line, path, value and allowed range.
Study read_study(const SourceText& yaml, const RobotDescription& robot, const TrajectoryLoader& loader = {});

}  // namespace codesign

#endif  // MECHANISM_CODESIGN_READING_STUDY_STUDY_READER_H_
