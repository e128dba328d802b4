// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "optimization/search_trials.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "description/study.h"
#include "equations/compiled_system.h"
#include "math/arrays.h"
#include "optimization/algorithm.h"
#include "optimization/lagrangian.h"
#include "optimization/search_results.h"
#include "problem/margins.h"
#include "sensitivity/gradient_engine.h"

namespace codesign {
namespace {

// Most columns of the root, which is computed for flat directions alone where gradients go
// backward.
constexpr Eigen::Index kMostRootColumns = 40;
constexpr double kStartCounts = 1e-3;  // the share of the slope at the start in the scale of (24j)
constexpr double kMostSlope = 1e-3;    // beyond which a loose tolerance does not let a search end
// Least multiplier that counts, in that scale: to widen a bound by 1 % is then worth a millionth.
constexpr double kLeastMultiplier = 1e-4;

}  // namespace

SearchTrials::SearchTrials(const Study& study, const OptimizerOptions& options,
                           const Ensemble& ensemble, const TrialObserver& observer,
                           const std::atomic<bool>* cancel, const Scaling& scaling,
                           SmoothProgram* program)
    : study_(study),
      options_(options),
      ensemble_(ensemble),
      observer_(observer),
      cancel_(cancel),
      scaling_(scaling),
      program_(*program),
      parameter_rows_(study, ensemble.scenarios()) {}

void SearchTrials::start(const Eigen::VectorXd& rho) {
  result_.initial.rho = result_.best.rho = rho;
  result_.optimality.influences.assign(study_.tuned.size(), false);
  parameter_rows_.require_numbers_at(rho);
}

bool SearchTrials::evaluate(const Eigen::VectorXd& rho, Derivatives derivatives) {
  last_ = ensemble_.evaluate(rho, derivatives, cancel_);
  if (last_.total.status.is_interrupted()) interruption_ = last_.total.status;
  if (interrupted()) return false;
  last_rho_ = rho;
  if (last_.total.status.ok()) program_.take(last_, rho);
  const Trial trial = note(last_, rho);
  if (observer_ && !observer_(trial)) interruption_ = {StatusCode::kCancelled, 0.0, "cancelled"};
  return !interrupted();
}

void SearchTrials::conclude(const std::string& failure) {
  result_.constraints.margins = parameter_rows_.margins(result_.best.rho);
  result_.constraints.watched = watched_at_best();
  for (std::size_t k = 0; k < study_.tuned.size(); ++k)
    if (program_.bounds_read(study_.tuned[k])) result_.optimality.influences[k] = true;
  if (have_best_) judge_stop();
  if (have_best_) append(search_warnings(study_, options_, result_), &result_.warnings);
  append(lost_branches_, &result_.warnings);
  result_.status = {StatusCode::kSuccess, study_.duration, ""};
  if (interrupted()) {
    result_.termination = name_of(interruption_.code);
    result_.status = with_best_kept(interruption_);
  } else if (!have_best_) {
    result_.status = first_failure_;
    result_.termination = "start_failed";
  } else {
    judge_end(failure);
  }
}

// The range of a signal takes a run.
const std::vector<WatchedResult>& SearchTrials::watched_at_best() {
  if (!best_watched_) {
    best_watched_ = program_.describe(best_.extremes, initial_extremes_, result_.best.rho);
    count_range_of_run(ensemble_.scenarios().front(), result_.best.rho, cancel_, &*best_watched_);
  }
  return *best_watched_;
}

bool SearchTrials::best_keeps_bounds() {
  if (best_violation_ == 0.0) return true;
  OptimizationResult best;
  best.constraints.margins = parameter_rows_.margins(result_.best.rho);
  best.constraints.watched = watched_at_best();
  return !best.constraints.watched.empty() && meets_constraints(best);
}

// If no point meets the constraints, rounding decides in which way an algorithm ends. The status is
// then kInfeasible even if the algorithm failed. Only an algorithm that gave up at its start, for
// example at equalities that depend on each other, has tried nothing and gets kAlgorithmFailed.
void SearchTrials::judge_end(const std::string& failure) {
  const bool has_failed = result_.termination == "algorithm_failed",
             is_outside = !best_keeps_bounds();
  std::string cause;
  if (is_outside)
    cause = all_met(result_.constraints.margins)
                ? describe_violated(result_.constraints.watched)
                : describe_unmet(study_, result_.constraints.margins);
  if (has_failed)
    cause += (cause.empty() ? "" : "; ") +
             ("the algorithm \"" + result_.algorithm + "\" failed (" + failure) +
             "); the best point so far is kept; try another algorithm or another start";
  if (cause.empty()) return;
  const bool has_tried = !has_failed || result_.cost.evaluations > 1;
  result_.status = {
      is_outside && has_tried ? StatusCode::kInfeasible : StatusCode::kAlgorithmFailed,
      study_.duration, cause};
}

Optimality SearchTrials::optimality_at(const EnsembleEvaluation& all, const Eigen::VectorXd& rho) {
  Optimality result = optimality(all, rho, scaling_, parameter_rows_, &program_, cancel_);
  // The algorithms read the program at the last point.
  if (last_.total.status.ok()) program_.take(last_, last_rho_);
  return result;
}

const Optimality& SearchTrials::best_optimality() {
  if (!best_optimality_) best_optimality_ = optimality_at(best_, result_.best.rho);
  return *best_optimality_;
}

double SearchTrials::slope_left() {
  const double slope = best_optimality().slope;
  return slope > 0.0 ? slope / result_.initial.slope : 0.0;
}

double SearchTrials::stationarity() {
  const double slope = best_optimality().slope;
  return slope > 0.0 ? slope / scale() : 0.0;
}

double SearchTrials::scale() const {
  return std::max(std::abs(result_.best.objective), kStartCounts * result_.initial.slope);
}

// Near an optimum the objective falls with the square of the slope.
double SearchTrials::most_slope() const {
  return std::min(kMostSlope, std::sqrt(options_.relative_tolerance));
}

/// Describes the best point as an optimum, or takes the word of success from a search that ended
/// elsewhere.
void SearchTrials::judge_stop() {
  const Optimality& at_best = best_optimality();
  if (cancel_ && *cancel_) {
    // The multipliers may have been cut short.
    if (!interrupted()) interruption_ = {StatusCode::kCancelled, 0.0, "cancelled"};
    result_.optimality.bound_multipliers.setZero(result_.best.rho.size());
    return;
  }
  result_.best.slope = at_best.slope;
  result_.optimality.stationarity = stationarity();
  // A multiplier far below the objective is what rounding leaves.
  result_.optimality.bound_multipliers =
      (at_best.bounds.array().abs() > kLeastMultiplier * scale()).select(at_best.bounds, 0.0);
  if (interrupted()) return;
  if (is_success(result_.termination) && best_keeps_bounds() && !is_stationary())
    result_.termination = "stopped_early";
  if (is_stationary()) find_flat_directions();
}

void SearchTrials::find_flat_directions() {
  const auto size = to_signed(study_.tuned.size());
  if (size < 2 || !is_sum_of_squares(study_)) return;
  Eigen::MatrixXd root = best_.total.jacobian_root;
  if (root.size() == 0) {
    // The Jacobian of so many parameters costs too much.
    if (size > kMostRootColumns && prefers_adjoint(*ensemble_.scenarios().front().system)) return;
    const EnsembleEvaluation again =
        ensemble_.evaluate(result_.best.rho, Derivatives::kGaussNewton, cancel_);
    result_.cost.statistics += again.total.statistics;
    if (!again.total.status.ok()) return;
    root = again.total.jacobian_root;
  }
  std::vector<bool> held(study_.tuned.size());
  for (std::size_t k = 0; k < held.size(); ++k) {
    const auto i = to_signed(k);
    root.col(i) *= scaling_.range(k);
    held[k] = !result_.optimality.influences[k] || result_.optimality.bound_multipliers[i] != 0.0;
  }
  result_.optimality.flat_directions = flat_directions(root, best_optimality().active, held);
  for (Eigen::Index k = 0; k < size; ++k)
    result_.optimality.flat_directions.row(k) *= scaling_.range(to_index(k));
}

Trial SearchTrials::note(const EnsembleEvaluation& all, const Eigen::VectorXd& rho) {
  const Evaluation& evaluation = all.total;
  Trial trial;
  trial.evaluation = ++result_.cost.evaluations;
  trial.status = evaluation.status;
  trial.rho = rho;
  result_.cost.statistics += evaluation.statistics;
  // At any trial point, since a jump of the objective there may end the search elsewhere.
  for (const Warning& warning : evaluation.warnings)
    if (warning.code == "branch_lost" && lost_branches_.empty()) lost_branches_.push_back(warning);
  if (evaluation.status.ok()) {
    trial.objective = evaluation.objective;
    trial.gradient = evaluation.gradient;
    trial.gradient_norm = scaling_.gradient_norm(evaluation.gradient);
    note_influences(all.gradients);
    for (const Extremes& extremes : all.extremes) note_influences(extremes.gradients);
    take_best(all, rho);
  } else {
    ++result_.cost.failed_evaluations;
    if (result_.cost.evaluations == 1) first_failure_ = evaluation.status;
  }
  trial.iteration = result_.cost.iterations;
  trial.best_objective = result_.best.objective;
  trial.best_violation = best_violation_;
  return trial;
}

/// @param gradients one row per tuned parameter.
void SearchTrials::note_influences(const Eigen::MatrixXd& gradients) {
  for (std::size_t k = 0; k < result_.optimality.influences.size(); ++k)
    if ((gradients.row(to_signed(k)).array() != 0.0).any()) result_.optimality.influences[k] = true;
}

double SearchTrials::violation(const EnsembleEvaluation& all, const Eigen::VectorXd& rho) const {
  double largest = program_.violation(all.extremes, rho);
  if (largest <= kMostViolation) largest = 0.0;
  for (const double margin : parameter_rows_.margins(rho))
    if (!(margin >= kMet))
      largest =
          std::max(largest, std::isnan(margin) ? std::numeric_limits<double>::infinity() : -margin);
  return largest;
}

void SearchTrials::take_best(const EnsembleEvaluation& all, const Eigen::VectorXd& rho) {
  const Evaluation& evaluation = all.total;
  const bool first = !have_best_;
  const double outside = violation(all, rho);
  if (first) {
    initial_extremes_ = all.extremes;
    result_.initial.objective = evaluation.objective;
    result_.initial.values = all.values;
    result_.initial.failed = all.failed;
    result_.initial.gradient = evaluation.gradient;
    result_.initial.slope = optimality_at(all, rho).slope;
  }
  const bool better = first || outside < best_violation_ ||
                      (outside == best_violation_ && evaluation.objective < result_.best.objective);
  if (!better) return;
  if (!first) ++result_.cost.iterations;
  have_best_ = true;
  best_violation_ = outside;
  result_.best.objective = evaluation.objective;
  result_.best.values = all.values;
  best_ = all;
  best_optimality_.reset();
  best_watched_.reset();
  result_.best.failed = all.failed;
  result_.best.gradient = evaluation.gradient;
  result_.warnings = evaluation.warnings;
  result_.best.rho = rho;
}

}  // namespace codesign
