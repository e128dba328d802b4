// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "identification/fit/residual_fit.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "identification/fit/inertia_search.h"
#include "identification/fit/residual_source.h"
#include "math/arrays.h"
#include "math/dense.h"
#include "optimization/levenberg_marquardt.h"
#include "optimization/multistart.h"
#include "sampling/sampler.h"
#include "statistics/identifiability.h"

namespace codesign {
namespace {

constexpr int kMostPasses = 10;
// With a prior, spreads count as found at this relative change of all of them, or at this share of
// the standard deviation of a spread.
constexpr double kSpreadTolerance = 1e-3;
constexpr double kSpreadShare = 0.1;
// Of the root mean square at the start: the lower limit of a spread, for exact data.
constexpr double kLeastSpread = 1e-9;

/// The spreads of residuals, bounded below by a fraction of the spreads at the start.
Eigen::VectorXd spreads_above(const Eigen::MatrixXd& residuals, const LossOptions& loss,
                              const Eigen::MatrixXd& counted, const Eigen::VectorXd& at_start) {
  Eigen::VectorXd spreads = spreads_of(residuals, loss, counted);
  for (Eigen::Index k = 0; k < spreads.size(); ++k)
    spreads[k] = std::max(spreads[k], kLeastSpread * at_start[k]);
  return spreads.unaryExpr([](double spread) { return spread > 0.0 ? spread : 1.0; });
}

/// A spread is known from `rows` residuals to 1 / sqrt(2 rows).
double spread_tolerance(const FitProblem& problem, Eigen::Index rows) {
  if (problem.prior.empty()) return kSpreadTolerance;
  return std::max(kSpreadTolerance, kSpreadShare / std::sqrt(2.0 * static_cast<double>(rows)));
}

/// Adds a prior to gradient and root of a point.
void add_prior(const FitPrior& prior, const Eigen::VectorXd& x, LeastSquaresPoint* point) {
  if (prior.empty()) return;
  const Eigen::MatrixXd slopes = prior.jacobian(x);
  point->gradient += 2.0 * (slopes.transpose() * prior.rows(x));
  Eigen::MatrixXd rows(point->root.rows() + slopes.rows(), x.size());
  rows << point->root, slopes;
  point->root = triangular_root(rows);
}

/// The cost with fixed spreads. Keeps residuals and Jacobian of the best point, and the counts.
class WeightedCost final : public LeastSquaresModel {
 public:
  /// @param modelled the prior that gradient and root count; the value counts that of the problem
  WeightedCost(const FitProblem& problem, FitPrior modelled, ResidualSource* source,
               const FitObserver& observer, ResidualFit* fit)
      : problem_(problem),
        modelled_(std::move(modelled)),
        spreads_(fit->spreads),
        source_(*source),
        counted_(source->counted()),
        observer_(observer),
        fit_(*fit) {}

  Outcome evaluate(const Eigen::VectorXd& x, LeastSquaresPoint* point) override {
    if (begins_at_best()) {
      residuals_ = fit_.residuals;
      jacobian_ = fit_.jacobian;
      take(x, point);
      return Outcome::kUsable;
    }
    const Status status = source_.evaluate(x, &residuals_, &jacobian_);
    if (status.code == StatusCode::kCancelled) return stop(status);
    ++fit_.evaluations;
    FitTrial trial{
        fit_.evaluations,  status,         std::numeric_limits<double>::infinity(), {}, x,
        source_.outputs(), fit_.iterations};
    if (!status.ok()) {
      ++fit_.failed_evaluations;
      fit_.last_failure = status;
      if (!is_begun_) fit_.status = status;
      return notify(trial) ? Outcome::kFailed : stop({StatusCode::kCancelled, 0.0, "cancelled"});
    }
    clear_rounding(x, &jacobian_);
    take(x, point);
    trial.cost = point->value;
    trial.iteration = fit_.iterations;
    trial.rms = rms_of(residuals_, counted_);
    return notify(trial) ? Outcome::kUsable : stop({StatusCode::kCancelled, 0.0, "cancelled"});
  }

  /// Whether the fit begins again with other spreads at its best point, whose residuals are known.
  /// Unknowns of the source's own are not.
  bool begins_at_best() const {
    return !is_begun_ && fit_.jacobian.size() > 0 && source_.own_unknowns() == 0;
  }

 private:
  void take(const Eigen::VectorXd& x, LeastSquaresPoint* point) {
    const WeightedResiduals weighted = weigh(residuals_, &jacobian_, spreads_, problem_.loss);
    point->value = weighted.value + problem_.prior.cost(x);
    point->gradient = 2.0 * (weighted.jacobian.transpose() * weighted.residuals.reshaped());
    point->root = triangular_root(weighted.jacobian);
    add_prior(modelled_, x, point);
    point->inner_decrease = source_.inner_decrease();
    keep(x, point->value);
  }

  Outcome stop(const Status& status) {
    fit_.status = status;
    return Outcome::kStop;
  }
  bool notify(const FitTrial& trial) const { return !observer_ || observer_(trial); }

  void keep(const Eigen::VectorXd& x, double cost) {
    if (is_begun_ && !(cost < fit_.cost)) return;
    if (is_begun_) ++fit_.iterations;
    is_begun_ = true;
    fit_.cost = cost;
    fit_.x = x;
    fit_.residuals = residuals_;
    fit_.jacobian = jacobian_;
  }

  const FitProblem& problem_;
  const FitPrior modelled_;
  const Eigen::VectorXd& spreads_;
  ResidualSource& source_;
  const Eigen::MatrixXd counted_;
  const FitObserver& observer_;
  ResidualFit& fit_;
  Eigen::MatrixXd residuals_, jacobian_;
  bool is_begun_ = false;
};

void search(const FitProblem& problem, ResidualSource* source, const FitObserver& observer,
            ResidualFit* fit) {
  source->count_by(fit->spreads, problem.loss);
  const std::vector<InertiaPrior> inertias =
      unbounded_inertias(problem.prior, problem.lower, problem.upper);
  FitPrior modelled = problem.prior;
  modelled.inertias.erase(std::remove_if(modelled.inertias.begin(), modelled.inertias.end(),
                                         [&inertias](const InertiaPrior& prior) {
                                           return std::any_of(inertias.begin(), inertias.end(),
                                                              [&prior](const InertiaPrior& linear) {
                                                                return linear.columns ==
                                                                       prior.columns;
                                                              });
                                         }),
                          modelled.inertias.end());
  WeightedCost cost(problem, std::move(modelled), source, observer, fit);
  LevenbergMarquardtOptions options;
  options.max_evaluations =
      std::max(1, problem.max_evaluations - fit->evaluations + (cost.begins_at_best() ? 1 : 0));
  options.relative_tolerance = problem.relative_tolerance;
  options.largest_first_step = std::numeric_limits<double>::infinity();
  Eigen::VectorXd x = fit->x;
  LeastSquaresPoint best;
  fit->termination = name_of(
      inertias.empty()
          ? minimize_squares(options, problem.lower, problem.upper, &cost, &x, &best)
          : minimize_with_inertias(options, problem.lower, problem.upper, inertias, &cost, &x));
}

/// A point that may start a fit.
struct ScreenedPoint {
  Eigen::VectorXd x;
  double spread = 0.0;
  bool is_start = false;  ///< of the study
};

std::vector<int> bounded_columns(const FitProblem& problem) {
  std::vector<int> columns;
  for (Eigen::Index k = 0; k < problem.start.size(); ++k)
    if (std::isfinite(problem.upper[k] - problem.lower[k])) columns.push_back(static_cast<int>(k));
  return columns;
}

std::vector<Eigen::VectorXd> points_of(const FitProblem& problem,
                                       const MultistartOptions& options) {
  const std::vector<int> columns = bounded_columns(problem);
  const Eigen::MatrixXd unit =
      unit_points(options.sampler, options.screen, static_cast<int>(columns.size()), options.seed);
  std::vector<Eigen::VectorXd> points(to_index(options.screen), problem.start);
  for (std::size_t i = 1; i < points.size(); ++i)
    for (std::size_t j = 0; j < columns.size(); ++j) {
      const int k = columns[j];
      points[i][k] = problem.lower[k] +
                     unit(to_signed(i), to_signed(j)) * (problem.upper[k] - problem.lower[k]);
    }
  return points;
}

/// The study's start, evaluated.
struct StudyStart {
  Status status;
  Eigen::MatrixXd residuals;
};

/// Chooses the starts, best first. @param interruption receives the status of a cancel.
std::vector<ScreenedPoint> screen(const FitProblem& problem, const MultistartOptions& options,
                                  const StudyStart& start, ResidualSource* source,
                                  FitSearches* searches, Status* interruption) {
  std::vector<ScreenedPoint> usable;
  Eigen::MatrixXd computed;
  bool is_start = true;  // the first point is the study's start
  for (const Eigen::VectorXd& x : points_of(problem, options)) {
    const Status status = is_start ? start.status : source->evaluate(x, &computed, nullptr);
    const Eigen::MatrixXd& residuals = is_start ? start.residuals : computed;
    if (status.code == StatusCode::kCancelled) {
      *interruption = status;
      break;
    }
    ++searches->screened;
    if (status.ok())
      usable.push_back({x, mean_spread(residuals, problem.loss, source->counted()), is_start});
    else
      ++searches->unusable;
    is_start = false;
  }
  std::stable_sort(
      usable.begin(), usable.end(),
      [](const ScreenedPoint& a, const ScreenedPoint& b) { return a.spread < b.spread; });
  usable.resize(std::min(usable.size(), to_index(options.starts)));
  return usable;
}

/// The result scaled by the range of the bounds, or by the magnitude of the start without bounds.
std::vector<double> scaled(const FitProblem& problem, const Eigen::VectorXd& x) {
  std::vector<double> result;
  for (Eigen::Index k = 0; k < x.size(); ++k) {
    const double range = problem.upper[k] - problem.lower[k];
    result.push_back(x[k] / (std::isfinite(range) && range > 0.0
                                 ? range
                                 : std::max(1.0, std::abs(problem.start[k]))));
  }
  return result;
}

StartResult describe(const ScreenedPoint& point, const ResidualFit& fit, const LossOptions& loss,
                     const Eigen::MatrixXd& counted) {
  const bool has_point = fit.residuals.size() > 0;
  StartResult start{point.x,        has_point ? fit.x : point.x,
                    point.spread,   point.spread,
                    fit.status,     fit.termination,
                    fit.evaluations};
  if (has_point) start.objective = mean_spread(fit.residuals, loss, counted);
  return start;
}

}  // namespace

WeightedResiduals weigh(const Eigen::MatrixXd& residuals, const Eigen::MatrixXd* jacobian,
                        const Eigen::VectorXd& spreads, const LossOptions& loss) {
  WeightedResiduals weighted;
  weighted.residuals.resize(residuals.rows(), residuals.cols());
  if (jacobian) weighted.jacobian.resize(jacobian->rows(), jacobian->cols());
  for (Eigen::Index k = 0; k < residuals.cols(); ++k)
    for (Eigen::Index row = 0; row < residuals.rows(); ++row) {
      const double u = residuals(row, k) / spreads[k];
      const LossValue counted = loss_of(loss, u);
      const double root = std::sqrt(counted.weight);
      weighted.value += counted.value;
      weighted.residuals(row, k) = root * u;
      const Eigen::Index at = k * residuals.rows() + row;
      if (jacobian) weighted.jacobian.row(at) = root / spreads[k] * jacobian->row(at);
    }
  return weighted;
}

ResidualFit fit_with_spreads(const FitProblem& problem, const Eigen::VectorXd& spreads,
                             ResidualSource* source, const FitObserver& observer) {
  ResidualFit fit;
  fit.x = problem.start.cwiseMax(problem.lower).cwiseMin(problem.upper);
  fit.spreads = spreads;
  search(problem, source, observer, &fit);
  return fit;
}

ResidualFit fit_residuals(const FitProblem& problem, ResidualSource* source,
                          const FitObserver& observer, const Eigen::MatrixXd* at_start) {
  ResidualFit fit;
  fit.x = problem.start.cwiseMax(problem.lower).cwiseMin(problem.upper);
  if (at_start)
    fit.start_residuals = *at_start;
  else
    fit.status = source->evaluate(fit.x, &fit.start_residuals, nullptr);
  if (!fit.status.ok()) {
    fit.termination = fit.status.code == StatusCode::kCancelled ? "cancelled" : "start_failed";
    return fit;
  }
  const Eigen::MatrixXd counted = source->counted();
  const Eigen::VectorXd rms_at_start = rms_of(fit.start_residuals, counted);
  fit.spreads = spreads_above(fit.start_residuals, problem.loss, counted, rms_at_start);
  for (int pass = 0; pass < kMostPasses; ++pass) {
    search(problem, source, observer, &fit);
    if (!fit.status.ok() || fit.evaluations >= problem.max_evaluations) break;
    const Eigen::VectorXd spreads =
        spreads_above(fit.residuals, problem.loss, counted, rms_at_start);
    const bool are_spreads_settled =
        ((spreads - fit.spreads).array().abs() <=
         spread_tolerance(problem, fit.residuals.rows()) * spreads.array())
            .all();
    // One spread of squares changes nothing but how much a prior counts.
    const bool has_one_scale =
        spreads.size() == 1 && problem.loss.kind == LossKind::kSquare && problem.prior.empty();
    fit.cost =
        weigh(fit.residuals, nullptr, spreads, problem.loss).value + problem.prior.cost(fit.x);
    fit.spreads = spreads;
    if (are_spreads_settled || has_one_scale) break;
  }
  return fit;
}

ResidualFit fit_from_starts(const FitProblem& problem, const MultistartOptions& options,
                            ResidualSource* source, const FitObserver& observer,
                            FitSearches* searches) {
  if (options.starts == 0) return fit_residuals(problem, source, observer);
  const Eigen::MatrixXd counted = source->counted();
  StudyStart start;
  start.status = source->evaluate(problem.start, &start.residuals, nullptr);
  ResidualFit best;
  Status interruption;
  int evaluations = 0, failed = 0;
  std::vector<std::vector<double>> ends;
  for (const ScreenedPoint& point :
       screen(problem, options, start, source, searches, &interruption)) {
    FitProblem from = problem;
    from.start = point.x;
    const auto numbered = [&](FitTrial trial) {
      trial.evaluation += evaluations;
      return !observer || observer(trial);
    };
    ResidualFit fit =
        fit_residuals(from, source, numbered, point.is_start ? &start.residuals : nullptr);
    evaluations += fit.evaluations;
    failed += fit.failed_evaluations;
    searches->starts.push_back(describe(point, fit, problem.loss, counted));
    ends.push_back(scaled(problem, searches->starts.back().rho));
    const bool is_better =
        fit.residuals.size() > 0 &&
        (best.residuals.size() == 0 || mean_spread(fit.residuals, problem.loss, counted) <
                                           mean_spread(best.residuals, problem.loss, counted));
    if (fit.status.code == StatusCode::kCancelled) interruption = fit.status;
    if (is_better || best.residuals.size() == 0) best = std::move(fit);
    if (!interruption.ok()) break;
  }
  searches->optima = cluster_optima(ends, options.cluster, &searches->starts);
  if (searches->starts.empty()) {
    best.status = interruption.ok() ? start.status : interruption;
    best.termination = interruption.ok() ? "start_failed" : "cancelled";
  } else if (!interruption.ok()) {
    best.status = interruption;
    best.termination = "cancelled";
  }
  // The start residuals in the result are the residuals at the study's start.
  if (start.status.ok() && best.residuals.size() > 0) best.start_residuals = start.residuals;
  best.evaluations = evaluations + searches->screened;
  best.failed_evaluations = failed + searches->unusable;
  return best;
}

}  // namespace codesign
