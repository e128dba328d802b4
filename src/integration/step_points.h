// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>

namespace codesign {

// At how many points of a step something is followed along its dense output; doc/theory.md (17d),
// (21c).

/// Most parts into which a step is divided.
constexpr int kMostStepParts = 8192;

/// Into how many parts a step is divided at first. @param share the step's part of the duration of
/// the study. @param least for any step. @param per_study in the duration.
inline int step_parts(double share, int least, int per_study) {
  return std::max(least, static_cast<int>(std::min(1.0, share) * per_study));
}

/// Whether so many parts show what turns round so often: what does so in every eighth part may do
/// it more often within one.
inline bool show_turns(int parts, int turns) { return turns < 2 || 8 * turns <= parts; }

}  // namespace codesign
