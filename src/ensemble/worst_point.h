// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <atomic>

#include "ensemble/ensemble.h"

namespace codesign {

/// Where the objective of a design is largest within the intervals of what is uncertain.
struct WorstPoint {
  Scenario scenario;
  double objective = 0.0;
  Statistics statistics;  ///< sums over the evaluations
  Status status;          ///< not ok if the search was interrupted
  bool is_known = false;  ///< false: nothing has an interval
};

/// The worst point of a design, from the worst of its samples on, and from those that are nearly as
/// bad: steps of a quarter of an interval
/// along each and along all that gain, halved where none gains; doc/theory.md (24b). A local
/// maximum to 1/128 of the intervals. Points that cannot be integrated are left out.
/// @param ensemble for kWorst. @param values psi of its scenarios at `rho`.
WorstPoint find_worst_point(const Problem& problem, const Ensemble& ensemble,
                            const Eigen::VectorXd& rho, const Eigen::VectorXd& values,
                            const std::atomic<bool>* cancel);

}  // namespace codesign
