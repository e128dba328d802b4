// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_ROS_WATCHED_MESSAGES_H_
#define MECHANISM_CODESIGN_ROS_WATCHED_MESSAGES_H_

#include <mechanism_codesign/WatchedSignal.h>

#include <vector>

#include "mechanism_codesign/optimization.h"

namespace codesign {

/// Messages for the signals with bounds or peaks. @param is_ensemble whether the study has runs or uncertain parameters.
std::vector<mechanism_codesign::WatchedSignal> watched_messages(const std::vector<WatchedResult>& watched, bool is_ensemble);

}  // namespace codesign

#endif  // MECHANISM_CODESIGN_ROS_WATCHED_MESSAGES_H_
