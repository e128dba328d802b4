// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "description/named_file.h"
#include "description/robot.h"
#include "description/study.h"
#include "reading/urdf/urdf_reader.h"

namespace codesign {

/// Reads a study in YAML; doc/study.md. Unknown, missing or repeated keys are errors.
/// @param robot supplies the default parameters and the names that the study may refer to.
/// @param loader reads trajectories from bags; without it a study that names one is rejected.
/// @param files reads other files that the study names, likewise.
/// @throws InputError naming file, line, path, value and allowed range.
Study read_study(const SourceText& yaml, const RobotDescription& robot,
                 const TrajectoryLoader& loader = {}, const FileLoader& files = {});

/// Whether a study says `base: floating`, which changes the model that it is read for. @throws
/// InputError for another value than fixed and floating
bool has_floating_base(const SourceText& yaml);

}  // namespace codesign
