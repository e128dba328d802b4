// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "optimization/search_trials.h"

namespace codesign {

/// One attempt of a search by Levenberg-Marquardt, doc/theory.md (24g): the mean over the scenarios, as a sum of squares, within bounds.
/// The study must have passed check_search(). Sets the termination. @param options its limit counts all evaluations of `trials`.
void search_squares(const OptimizerOptions& options, const Eigen::VectorXd& start, const Scaling& scaling, SearchTrials* trials);

}  // namespace codesign
