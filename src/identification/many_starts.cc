// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "identification/many_starts.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "math/arrays.h"
#include "optimization/multistart.h"
#include "sampling/sampler.h"

namespace codesign {
namespace {

/// A point that may start a fit.
struct ScreenedPoint {
  Eigen::VectorXd x;
  double spread = 0.0;
};

std::vector<int> bounded_columns(const FitProblem& problem) {
  std::vector<int> columns;
  for (Eigen::Index k = 0; k < problem.start.size(); ++k)
    if (std::isfinite(problem.upper[k] - problem.lower[k])) columns.push_back(static_cast<int>(k));
  return columns;
}

std::vector<Eigen::VectorXd> points_of(const FitProblem& problem, const MultistartOptions& options) {
  const std::vector<int> columns = bounded_columns(problem);
  const Eigen::MatrixXd unit = unit_points(options.sampler, options.screen, static_cast<int>(columns.size()), options.seed);
  std::vector<Eigen::VectorXd> points(to_index(options.screen), problem.start);
  for (std::size_t i = 1; i < points.size(); ++i)
    for (std::size_t j = 0; j < columns.size(); ++j) {
      const int k = columns[j];
      points[i][k] =
          problem.lower[k] + unit(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) * (problem.upper[k] - problem.lower[k]);
    }
  return points;
}

/// Chooses the starts, best first. @param interruption receives the status of a cancel.
std::vector<ScreenedPoint> screen(const FitProblem& problem, const MultistartOptions& options, ResidualSource* source,
                                  FitSearches* searches, Status* interruption) {
  std::vector<ScreenedPoint> usable;
  Eigen::MatrixXd residuals;
  for (const Eigen::VectorXd& x : points_of(problem, options)) {
    const Status status = source->evaluate(x, &residuals, nullptr);
    if (status.code == StatusCode::kCancelled) {
      *interruption = status;
      break;
    }
    ++searches->screened;
    if (status.ok())
      usable.push_back({x, mean_spread(residuals, problem.loss)});
    else
      ++searches->unusable;
  }
  std::stable_sort(usable.begin(), usable.end(), [](const ScreenedPoint& a, const ScreenedPoint& b) { return a.spread < b.spread; });
  usable.resize(std::min(usable.size(), to_index(options.starts)));
  return usable;
}

/// The result scaled by the range of the bounds, or by the magnitude of the start without bounds.
std::vector<double> scaled(const FitProblem& problem, const Eigen::VectorXd& x) {
  std::vector<double> result;
  for (Eigen::Index k = 0; k < x.size(); ++k) {
    const double range = problem.upper[k] - problem.lower[k];
    result.push_back(x[k] / (std::isfinite(range) && range > 0.0 ? range : std::max(1.0, std::abs(problem.start[k]))));
  }
  return result;
}

StartResult describe(const ScreenedPoint& point, const ResidualFit& fit, const LossOptions& loss) {
  const bool has_point = fit.residuals.size() > 0;
  StartResult start{point.x, has_point ? fit.x : point.x, point.spread, point.spread, fit.status, fit.termination, fit.evaluations};
  if (has_point) start.objective = mean_spread(fit.residuals, loss);
  return start;
}

}  // namespace

double mean_spread(const Eigen::MatrixXd& residuals, const LossOptions& loss) {
  return std::exp(spreads_of(residuals, loss).array().log().mean());
}

ResidualFit fit_from_starts(const FitProblem& problem, const MultistartOptions& options, ResidualSource* source,
                            const FitObserver& observer, FitSearches* searches) {
  if (options.starts == 0) return fit_residuals(problem, source, observer);
  Eigen::MatrixXd at_start;
  const Status start_status = source->evaluate(problem.start, &at_start, nullptr);
  ResidualFit best;
  Status interruption;
  int evaluations = 0, failed = 0;
  std::vector<std::vector<double>> ends;
  for (const ScreenedPoint& point : screen(problem, options, source, searches, &interruption)) {
    FitProblem from = problem;
    from.start = point.x;
    ResidualFit fit = fit_residuals(from, source, [&](FitTrial trial) {
      trial.evaluation += evaluations;
      return !observer || observer(trial);
    });
    evaluations += fit.evaluations;
    failed += fit.failed_evaluations;
    searches->starts.push_back(describe(point, fit, problem.loss));
    ends.push_back(scaled(problem, searches->starts.back().rho));
    const bool is_better = fit.residuals.size() > 0 && (best.residuals.size() == 0 || mean_spread(fit.residuals, problem.loss) <
                                                                                          mean_spread(best.residuals, problem.loss));
    if (fit.status.code == StatusCode::kCancelled) interruption = fit.status;
    if (is_better || best.residuals.size() == 0) best = std::move(fit);
    if (!interruption.ok()) break;
  }
  searches->optima = cluster_optima(ends, options.cluster, &searches->starts);
  if (searches->starts.empty()) {
    best.status = interruption.ok() ? start_status : interruption;
    best.termination = interruption.ok() ? "start_failed" : "cancelled";
  } else if (!interruption.ok()) {
    best.status = interruption;
    best.termination = "cancelled";
  }
  // The start residuals in the result are the residuals at the study's start.
  if (start_status.ok() && best.residuals.size() > 0) best.start_residuals = at_start;
  best.evaluations = evaluations + searches->screened;
  best.failed_evaluations = failed + searches->unusable;
  return best;
}

}  // namespace codesign
