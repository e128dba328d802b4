// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <functional>
#include <string>

#include "excitation/excitation_program.h"

namespace codesign {

/// One evaluation of a search, for reports of progress.
struct ExcitationTrial {
  int start = 0;       ///< from 1
  int evaluation = 0;  ///< from 1 in each search
  Status status;
  double criterion = 0.0;  ///< (46a)
  double worst = 0.0;      ///< largest |z| at the samples; above 1: a limit is violated
};
/// Called after each evaluation; returning false ends the search with the best point so far.
using ExcitationObserver = std::function<bool(const ExcitationTrial&)>;

/// The best point of a search that keeps all limits at the samples.
struct TrajectorySearchResult {
  Eigen::VectorXd x;
  double criterion = 0.0, initial_criterion = 0.0;
  int evaluations = 0;
  std::string termination;
};

/// Searches twice from one start with an algorithm of NLopt: with blunt envelopes of the limits,
/// then with sharp envelopes.
/// @param x the start, within the limits and with a finite criterion.
TrajectorySearchResult search_trajectory(const ExcitationDescription& description,
                                         const Eigen::VectorXd& x, int start,
                                         const ExcitationObserver& observer,
                                         ExcitationProgram* program);

}  // namespace codesign
