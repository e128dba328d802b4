// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "optimization/search_trials.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "description/parameter_switches.h"
#include "description/study.h"
#include "equations/compiled_system.h"
#include "math/arrays.h"
#include "optimization/algorithm.h"
#include "optimization/lagrangian.h"
#include "optimization/search_results.h"
#include "problem/margins.h"

namespace codesign {
namespace {

constexpr double kStartCounts = 1e-3;  // the share of the slope at the start in the scale of (24j)
// The share of the change of a sum of squares over the ranges that counts at least: stationary
// to 0.001, its last step would be 1e-13 of a range, which is rounding.
constexpr double kLeastOfSquares = 1e-10;
constexpr double kMostSlope = 1e-3;  // beyond which a loose tolerance does not let a search end

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
      judged_(scaling),
      reaches_(Eigen::VectorXd::Constant(to_signed(study.tuned.size()),
                                         std::numeric_limits<double>::infinity())),
      program_(*program),
      parameter_rows_(study, ensemble.scenarios()) {}

void SearchTrials::start(const Eigen::VectorXd& rho) {
  result_.initial.rho = result_.best.rho = rho;
  result_.optimality.influences.assign(study_.tuned.size(), false);
  slopes_ = changes_ = result_.optimality.influences;
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
  if (have_best_ && !interrupted() && is_stationary()) finds_lower_point();
  if (have_best_) judge_stop();
  if (have_best_) append(search_warnings(study_, options_, result_), &result_.warnings);
  append(lost_branches_, &result_.warnings);
  if (have_best_ && ensemble_.scenarios().size() == 1)
    append(event_changes_.warnings(result_.best.rho, best_.total.events, extents(), study_.file),
           &result_.warnings);
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
    best_watched_ = program_.describe(best_.extremes, initial_.extremes, result_.best.rho);
    count_range_of_run(ensemble_.scenarios().front(), result_.best.rho, cancel_, &*best_watched_);
  }
  return *best_watched_;
}

bool SearchTrials::best_keeps_bounds() {
  if (best_violation_ == 0.0) return true;
  OptimizationResult best;
  best.constraints.margins = parameter_rows_.margins(result_.best.rho);
  best.constraints.watched = watched_at_best();
  return !best.constraints.watched.empty() && meets_constraints(study_, best);
}

// If no point meets the constraints, rounding decides in which way an algorithm ends. The status is
// then kInfeasible even if the algorithm failed. Only an algorithm that gave up at its start, for
// example at equalities that depend on each other, has tried nothing and gets kAlgorithmFailed.
void SearchTrials::judge_end(const std::string& failure) {
  const bool has_failed = result_.termination == "algorithm_failed",
             is_outside = !best_keeps_bounds();
  std::string cause;
  if (is_outside)
    cause = all_met(study_, result_.constraints.margins)
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
  Optimality result = optimality(all, rho, judged_, parameter_rows_, &program_, cancel_);
  // The algorithms read the program at the last point.
  if (last_.total.status.ok()) program_.take(last_, last_rho_);
  return result;
}

const Optimality& SearchTrials::best_optimality() {
  if (best_optimality_) return *best_optimality_;
  judged_scaling();
  if (!initial_slope_) initial_slope_ = optimality_at(initial_, result_.initial.rho).slope;
  result_.initial.slope = *initial_slope_;
  best_optimality_ = optimality_at(best_, result_.best.rho);
  return *best_optimality_;
}

const Scaling& SearchTrials::judged_scaling() {
  for (Eigen::Index k = 0; k < reaches_.size(); ++k) {
    const double reach = std::isfinite(reaches_[k]) ? reaches_[k] : 0.0;
    if (!judged_.reach(to_index(k), result_.best.rho[k], reach)) continue;
    best_optimality_.reset();
    initial_slope_.reset();
  }
  return judged_;
}

// A slope that is small where it was met tells nothing if a steeper one was met elsewhere.
void SearchTrials::note_reaches(const Evaluation& evaluation) {
  for (Eigen::Index k = 0; k < reaches_.size(); ++k)
    if (const double slope = std::abs(evaluation.gradient[k]); slope > 0.0)
      reaches_[k] = std::min(reaches_[k], std::abs(evaluation.objective) / slope);
}

double SearchTrials::slope_left() {
  const double slope = best_optimality().slope;
  return slope > 0.0 ? slope / result_.initial.slope : 0.0;
}

double SearchTrials::stationarity() {
  const double slope = best_optimality().slope;
  return slope > 0.0 ? slope / scale() : 0.0;
}

double SearchTrials::scale() {
  const double psi = std::abs(result_.best.objective), slope = best_optimality().slope,
               scale = std::max(psi, kStartCounts * result_.initial.slope);
  if (!(psi > 0.0) || !is_sum_of_squares(study_) ||
      std::any_of(study_.watched.begin(), study_.watched.end(), is_term))
    return scale;
  // Of a sum of squares, at least |R|^2: what the objective changes over the ranges.
  return std::max(scale, kLeastOfSquares * slope * slope / (4.0 * psi));
}

// Near an optimum the objective falls with the square of the slope.
double most_stationarity(const OptimizerOptions& options) {
  return std::min(kMostSlope, std::sqrt(options.relative_tolerance));
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
  const Eigen::VectorXd unit = extents();
  for (Eigen::Index k = 0; k < unit.size(); ++k)
    if (judged_.range(to_index(k)) != unit[k])
      result_.optimality.bound_multipliers[k] *= unit[k] / judged_.range(to_index(k));
  if (interrupted()) return;
  result_.optimality.unjudged = find_unjudged();
  const bool may_claim = result_.optimality.unjudged.empty() && is_stationary();
  if (!result_.optimality.unjudged.empty())
    result_.optimality.stationarity = std::numeric_limits<double>::quiet_NaN();
  if (is_success(result_.termination) && best_keeps_bounds() && !may_claim)
    result_.termination = "stopped_early";
}

/// What no slope sees, (24k). A sum of squares that vanishes is least all the same.
std::string SearchTrials::find_unjudged() const {
  if (result_.best.objective == 0.0 && is_sum_of_squares(study_)) return "";
  std::string text;
  const auto add = [&text](const std::string& part) { text += (text.empty() ? "" : ", ") + part; };
  const std::vector<ParameterJump> jumps = find_jumps(study_, result_.best.rho);
  const auto jumps_with = [&jumps](int parameter) {
    return std::any_of(jumps.begin(), jumps.end(), [parameter](const ParameterJump& jump) {
      return jump.parameter == parameter;
    });
  };
  const auto quoted = [this](int parameter) {
    return "\"" + study_.parameters[to_index(parameter)].name + "\"";
  };
  for (const ParameterJump& jump : jumps)
    add((jump.parameter < 0 ? "what it tunes" : quoted(jump.parameter)) + " (" + jump.text + ")");
  for (std::size_t k = 0; k < study_.tuned.size(); ++k)
    if (changes_[k] && !slopes_[k] && !jumps_with(study_.tuned[k]))
      add(quoted(study_.tuned[k]) + " (its derivative is zero wherever it was asked for)");
  return text.empty() ? "" : "the objective jumps with " + text;
}

Trial SearchTrials::note(const EnsembleEvaluation& all, const Eigen::VectorXd& rho) {
  const Evaluation& evaluation = all.total;
  Trial trial;
  trial.evaluation = ++result_.cost.evaluations;
  trial.status = evaluation.status;
  trial.rho = rho;
  trial.events = evaluation.events.count;
  result_.cost.statistics += evaluation.statistics;
  // At any trial point, since a jump of the objective there may end the search elsewhere.
  for (const Warning& warning : evaluation.warnings)
    if (warning.code == "branch_lost" && lost_branches_.empty()) lost_branches_.push_back(warning);
  if (evaluation.status.ok()) {
    trial.objective = evaluation.objective;
    trial.gradient = evaluation.gradient;
    trial.gradient_norm = scaling_.gradient_norm(evaluation.gradient);
    note_reaches(evaluation);
    note_influences(all.gradients);
    // Of several objectives one may watch signals where another one has none.
    for (const Extremes& extremes : all.extremes)
      if (extremes.values.size() > 0) note_influences(extremes.gradients);
    note_change(all, rho);
    event_changes_.note(rho, evaluation.events);
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
  note_slopes(gradients);
}

void SearchTrials::note_slopes(const Eigen::MatrixXd& gradients) {
  for (std::size_t k = 0; k < slopes_.size(); ++k)
    if ((gradients.row(to_signed(k)).array() != 0.0).any()) slopes_[k] = true;
}

/// The objective of a point that differs from the best one in one parameter may differ where the
/// derivative is zero, as of a step.
void SearchTrials::note_change(const EnsembleEvaluation& all, const Eigen::VectorXd& rho) {
  if (!have_best_ || all.total.objective == result_.best.objective) return;
  const auto differs = (rho.array() != result_.best.rho.array()).eval();
  if (differs.count() != 1) return;
  const bool counts = std::abs(all.total.objective - result_.best.objective) >
                      options_.relative_tolerance * std::abs(result_.best.objective);
  for (std::size_t k = 0; k < result_.optimality.influences.size(); ++k)
    if (differs[to_signed(k)]) {
      result_.optimality.influences[k] = true;
      if (counts) changes_[k] = true;
    }
}

double SearchTrials::violation(const EnsembleEvaluation& all, const Eigen::VectorXd& rho) const {
  double largest = program_.violation(all.extremes, rho);
  if (largest <= kMostViolation) largest = 0.0;
  const Eigen::VectorXd margins = parameter_rows_.margins(rho);
  for (std::size_t k = 0; k < study_.constraints.size(); ++k) {
    const double margin = margins[to_signed(k)];
    if (!(margin >= least_margin(study_, study_.constraints[k])))
      largest =
          std::max(largest, std::isnan(margin) ? std::numeric_limits<double>::infinity() : -margin);
  }
  return largest;
}

void SearchTrials::take_best(const EnsembleEvaluation& all, const Eigen::VectorXd& rho) {
  const Evaluation& evaluation = all.total;
  const bool first = !have_best_;
  const double outside = violation(all, rho);
  if (first) {
    initial_ = all;
    result_.initial.objective = evaluation.objective;
    result_.initial.values = all.values;
    result_.initial.failed = all.failed;
    result_.initial.gradient = evaluation.gradient;
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
  looked_beside_ = false;
  result_.optimality.flat_directions.resize(0, 0);
  result_.optimality.flat_points.resize(0, 0);
  result_.best.failed = all.failed;
  result_.best.gradient = evaluation.gradient;
  result_.best.events = evaluation.events;
  result_.warnings = evaluation.warnings;
  result_.best.rho = rho;
}

}  // namespace codesign
