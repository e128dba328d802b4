// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "identification/effort/effort_doubts.h"

namespace codesign {

/// A doubt about the study's filter, if it leaves less than half of a joint's motion.
std::optional<EffortDoubt> doubt_filter(const std::vector<JointRecording>& recordings,
                                        FilterOptions filter, const std::string& joint);

}  // namespace codesign
