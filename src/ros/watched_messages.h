// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mechanism_codesign/WatchedSignal.h>

#include <vector>

#include "mechanism_codesign/optimization.h"

namespace codesign {

/// Messages for the signals with bounds or peaks. @param is_ensemble whether the study has runs or uncertain parameters.
std::vector<mechanism_codesign::WatchedSignal> watched_messages(const std::vector<WatchedResult>& watched, bool is_ensemble);

}  // namespace codesign
