// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "optimization/search_trials.h"

#include <cmath>
#include <limits>

#include "optimization/search_warnings.h"
#include "optimization/violated_bounds.h"
#include "problem/margins.h"

namespace codesign {
SearchTrials::SearchTrials(const Study& study, const OptimizerOptions& options, const Ensemble& ensemble, const TrialObserver& observer,
                           const std::atomic<bool>* cancel, const Scaling& scaling, SmoothProgram* program)
    : study_(study),
      options_(options),
      ensemble_(ensemble),
      observer_(observer),
      cancel_(cancel),
      scaling_(scaling),
      program_(*program),
      parameter_rows_(study, ensemble.scenarios()) {}

void SearchTrials::start(const Eigen::VectorXd& rho) {
  result_.initial_rho = result_.rho = rho;
  result_.influences.assign(study_.tuned.size(), false);
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
  result_.margins = parameter_rows_.margins(result_.rho);
  result_.watched = program_.describe(best_.extremes, initial_extremes_, result_.rho);
  for (std::size_t k = 0; k < study_.tuned.size(); ++k)
    if (program_.bounds_read(study_.tuned[k])) result_.influences[k] = true;
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

bool SearchTrials::best_keeps_bounds() const {
  if (best_violation_ == 0.0) return true;
  OptimizationResult best;
  best.margins = parameter_rows_.margins(result_.rho);
  best.watched = program_.describe(best_.extremes, initial_extremes_, result_.rho);
  return !best.watched.empty() && meets_constraints(best);
}

// If no point meets the constraints, rounding decides in which way an algorithm ends. The status is then kInfeasible even if the algorithm
// failed. Only an algorithm that gave up at its start, for example at equalities that depend on each other, has tried nothing and gets
// kAlgorithmFailed.
void SearchTrials::judge_end(const std::string& failure) {
  const bool has_failed = result_.termination == "algorithm_failed", is_outside = !best_keeps_bounds();
  std::string cause;
  if (is_outside) cause = all_met(result_.margins) ? describe_violated(result_.watched) : describe_unmet(study_, result_.margins);
  if (has_failed)
    cause += (cause.empty() ? "" : "; ") + ("the algorithm \"" + options_.algorithm + "\" failed (" + failure) +
             "); the best point so far is kept; try another algorithm or another start";
  if (cause.empty()) return;
  const bool has_tried = !has_failed || result_.evaluations > 1;
  result_.status = {is_outside && has_tried ? StatusCode::kInfeasible : StatusCode::kAlgorithmFailed, study_.duration, cause};
}

Trial SearchTrials::note(const EnsembleEvaluation& all, const Eigen::VectorXd& rho) {
  const Evaluation& evaluation = all.total;
  Trial trial;
  trial.evaluation = ++result_.evaluations;
  trial.status = evaluation.status;
  trial.rho = rho;
  result_.statistics += evaluation.statistics;
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
    ++result_.failed_evaluations;
    if (result_.evaluations == 1) first_failure_ = evaluation.status;
  }
  trial.iteration = result_.iterations;
  trial.best_objective = result_.objective;
  trial.best_violation = best_violation_;
  return trial;
}

/// @param gradients one row per tuned parameter.
void SearchTrials::note_influences(const Eigen::MatrixXd& gradients) {
  for (std::size_t k = 0; k < result_.influences.size(); ++k)
    if ((gradients.row(static_cast<Eigen::Index>(k)).array() != 0.0).any()) result_.influences[k] = true;
}

double SearchTrials::violation(const EnsembleEvaluation& all, const Eigen::VectorXd& rho) const {
  double largest = program_.violation(all.extremes, rho);
  if (largest <= kMostViolation) largest = 0.0;
  for (const double margin : parameter_rows_.margins(rho))
    if (!(margin >= kMet)) largest = std::max(largest, std::isnan(margin) ? std::numeric_limits<double>::infinity() : -margin);
  return largest;
}

void SearchTrials::take_best(const EnsembleEvaluation& all, const Eigen::VectorXd& rho) {
  const Evaluation& evaluation = all.total;
  const bool first = !have_best_;
  const double outside = violation(all, rho);
  if (first) {
    initial_extremes_ = all.extremes;
    result_.initial_objective = evaluation.objective;
    result_.initial_values = all.values;
    result_.initial_failed = all.failed;
    result_.initial_gradient = evaluation.gradient;
  }
  const bool better = first || outside < best_violation_ || (outside == best_violation_ && evaluation.objective < result_.objective);
  if (!better) return;
  if (!first) ++result_.iterations;
  have_best_ = true;
  best_violation_ = outside;
  result_.objective = evaluation.objective;
  result_.values = all.values;
  if (program_.has_signals()) best_ = all;
  result_.failed = all.failed;
  result_.gradient = evaluation.gradient;
  result_.warnings = evaluation.warnings;
  result_.rho = rho;
}

}  // namespace codesign
