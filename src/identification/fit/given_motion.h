// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "description/study.h"
#include "mechanism_codesign/problem.h"
#include "recordings/joint_recording.h"

namespace codesign {

/// Recordings with the joints whose motion the study gives and which they lack: they have the
/// positions and velocities of the functions at the times of the recording, whose clock is that of
/// the study. The values of parameters are those of the recording, else of the study.
/// @returns nothing if no recording lacks one.
/// @throws InputError if the study tunes a parameter of such a function, since the derivatives by
/// it would be missing.
std::optional<StudyRecordings> with_given_motions(const Problem& problem,
                                                  const StudyRecordings& recordings);

}  // namespace codesign
