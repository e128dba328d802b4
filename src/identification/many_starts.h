// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "description/ensemble.h"
#include "identification/residual_fit.h"
#include "mechanism_codesign/optimization.h"

namespace codesign {

/// The outcome of fits from several starts. The objective of a start, a search and an optimum is the mean spread of its residuals.
struct FitSearches {
  std::vector<StartResult> starts;  ///< best start first; empty if there was one start only
  std::vector<Optimum> optima;      ///< points at which the fits ended, best first
  int screened = 0, unusable = 0;   ///< number of points evaluated to choose the starts, and of these the number of failed points
};

/// The geometric mean over the outputs of the spreads of their residuals. It ranks fits from several starts; doc/theory.md (39a).
double mean_spread(const Eigen::MatrixXd& residuals, const LossOptions& loss);

/// fit_residuals() from several starts, `multistart:` of the study: residuals are computed at points of the sampler within the bounds, the
/// study's own start first, and the best ones start fits. A number without two finite bounds keeps its start. Without several starts it is
/// fit_residuals().
/// @return the best fit, with the counts of all. A cancelled fit ends the search; the best fit so far is returned with kCancelled.
ResidualFit fit_from_starts(const FitProblem& problem, const MultistartOptions& options, ResidualSource* source,
                            const FitObserver& observer, FitSearches* searches);

}  // namespace codesign
