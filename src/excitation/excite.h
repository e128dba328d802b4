// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <atomic>

#include "excitation/excitation_result.h"
#include "excitation/trajectory_search.h"
#include "mechanism_codesign/problem.h"
#include "recordings/joint_recording.h"

namespace codesign {

/// Finds the trajectory within all limits from whose recording the numbers of `identify:` are
/// expected to be known best, doc/theory.md (45)-(47), at the parameters' start values.
/// @param problem with blocks `excite` and `identify` in its study. @param observer called after
/// each evaluation; false ends the search.
/// @param cancel the search ends soon after it is set, from any thread, with the best trajectory so
/// far; null: never
/// @param compared a recording or table of a trajectory that is judged beside the one found; null:
/// none
/// @throws InputError as motion_limits() and ExcitedMotion, and for a compared trajectory without
/// positions of an excited joint
ExcitationResult excite(const Problem& problem, const ExcitationObserver& observer,
                        const std::atomic<bool>* cancel, const JointRecording* compared = nullptr);

}  // namespace codesign
