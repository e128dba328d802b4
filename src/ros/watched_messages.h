// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_ROS_WATCHED_MESSAGES_H_
#define MECHANISM_CODESIGN_ROS_WATCHED_MESSAGES_H_

#include <mechanism_codesign/WatchedSignal.h>

#include <vector>

#include "mechanism_codesign/optimization.h"
#include "problem/load_problem.h"

namespace codesign {

/// Messages for the signals with bounds or peaks, with their bounds at the tuned parameters `rho`.
/// @param watched one entry per watched signal of the study, in its order, or none.
std::vector<mechanism_codesign::WatchedSignal> watched_messages(const Problem& problem, const std::vector<WatchedResult>& watched,
                                                                const Eigen::VectorXd& rho);

}  // namespace codesign

#endif  // MECHANISM_CODESIGN_ROS_WATCHED_MESSAGES_H_
