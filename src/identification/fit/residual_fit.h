// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <functional>
#include <string>
#include <vector>

#include "description/ensemble.h"
#include "description/identification.h"
#include "identification/fit/fit_prior.h"
#include "identification/fit/residual_source.h"
#include "identification/fit/residual_spreads.h"
#include "mechanism_codesign/optimization.h"
#include "mechanism_codesign/optimizer_options.h"

namespace codesign {

/// Residuals as a fit counts them: divided by the spread s_k of their output k, times the square
/// roots of the weights of the loss.
struct WeightedResiduals {
  double value = 0.0;         ///< sum of rho(r / s)
  Eigen::MatrixXd residuals;  ///< rows x outputs
  Eigen::MatrixXd jacobian;   ///< (rows outputs) x p; empty if none was given
};

/// @param spreads positive, one per output. @param jacobian may be null
WeightedResiduals weigh(const Eigen::MatrixXd& residuals, const Eigen::MatrixXd* jacobian,
                        const Eigen::VectorXd& spreads, const LossOptions& loss);

/// One evaluation of a fit, for progress.
struct FitTrial {
  int evaluation = 0;  ///< from 1
  Status status;       ///< not ok: the fit turns back from this point
  double cost = 0.0;   ///< sum of rho(r / s); infinite if the status is not ok
  /// root mean square of the residuals of each output, in its unit; empty if the status is not ok
  Eigen::VectorXd rms;
  Eigen::VectorXd x;                      ///< the point
  std::vector<std::string> outputs = {};  ///< ResidualSource::outputs()
  int iteration = 0;                      ///< improvements of the best point so far
  /// 1, 2, ...: an evaluation for the profile of this number; 0: an evaluation of the fit
  int profile = 0;
  int profiles = 0;  ///< numbers with a profile
};
/// Called after each evaluation; returning false ends the fit with kCancelled and the best point.
using FitObserver = std::function<bool(const FitTrial&)>;

/// Limits of a fit.
struct FitProblem {
  /// the start lies within the bounds, which may be infinite or equal
  Eigen::VectorXd start, lower, upper;
  LossOptions loss;
  int max_evaluations = 200;
  double relative_tolerance = 1e-6;  ///< of the cost
  FitPrior prior;                    ///< what is known before; doc/theory.md (39b)
};

/// The best point of a fit.
struct ResidualFit {
  /// ok, kCancelled, or the status of a failed start; the members below are then empty
  Status status;
  std::string termination;  ///< as OptimizationResult::termination
  Eigen::VectorXd x;
  /// s_k: root mean square of the residuals; with a robust loss 1.4826 times the median of |r|
  Eigen::VectorXd spreads;
  double cost = 0.0;                    ///< sum of rho(r / s) at x, and of the prior
  Eigen::MatrixXd residuals, jacobian;  ///< at x, not weighted
  Eigen::MatrixXd start_residuals;
  int evaluations = 0, failed_evaluations = 0, iterations = 0;
  Status last_failure;  ///< status of the last failed evaluation; ok if none failed
};

/// Minimizes the sum over all residuals of rho(r_k / s_k) by Levenberg-Marquardt within bounds,
/// doc/theory.md (39). With several outputs or a robust loss, the spreads s_k come from the fit
/// itself: the fit is repeated until they no longer change, at most ten times.
/// @param at_start the residuals at the start, if they are known; null: they are computed.
ResidualFit fit_residuals(const FitProblem& problem, ResidualSource* source,
                          const FitObserver& observer = {},
                          const Eigen::MatrixXd* at_start = nullptr);

/// fit_residuals() with known spreads, in one search.
ResidualFit fit_with_spreads(const FitProblem& problem, const Eigen::VectorXd& spreads,
                             ResidualSource* source, const FitObserver& observer = {});

/// The outcome of fits from several starts. The objective of a start, a search and an optimum is
/// the mean spread of its residuals.
struct FitSearches {
  std::vector<StartResult> starts;  ///< best start first; empty if there was one start only
  std::vector<Optimum> optima;      ///< points at which the fits ended, best first
  /// number of points evaluated to choose the starts, and of these the number of failed points
  int screened = 0, unusable = 0;
};

/// fit_residuals() from several starts, `multistart:` of the study: residuals are computed at
/// points of the sampler within the bounds, the study's own start first, and the best ones start
/// fits. A number without two finite bounds keeps its start. Without several starts it is
/// fit_residuals().
/// @return the best fit, with the counts of all. A cancelled fit ends the search; the best fit so
/// far is returned with kCancelled.
ResidualFit fit_from_starts(const FitProblem& problem, const MultistartOptions& options,
                            ResidualSource* source, const FitObserver& observer,
                            FitSearches* searches);

}  // namespace codesign
