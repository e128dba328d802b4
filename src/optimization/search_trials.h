// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "ensemble/ensemble.h"
#include "ensemble/parameter_rows.h"
#include "mechanism_codesign/optimization.h"
#include "optimization/event_changes.h"
#include "optimization/lagrangian.h"
#include "optimization/scaling.h"
#include "optimization/smooth_program.h"

namespace codesign {

/// Least multiplier that counts, in the scale of (24j): to widen a bound by 1 % is then worth a
/// millionth.
constexpr double kLeastMultiplier = 1e-4;

/// The stationarity() at which a search may end: the root of the relative tolerance of the
/// objective, and at most 0.001.
double most_stationarity(const OptimizerOptions& options);

/// The status of a search that ended because one of its evaluations was interrupted.
inline Status with_best_kept(const Status& interruption) {
  return {interruption.code, 0.0, interruption.cause + "; the best point so far is kept"};
}

/// The trial points of one local search with any algorithm. Evaluates each point, calls the
/// observer, keeps the best point, and determines at the end how the search ended. Of two points
/// that violate constraints, the point with the smaller violation is better.
class SearchTrials {
 public:
  /// All arguments but `start` must outlive this.
  SearchTrials(const Study& study, const OptimizerOptions& options, const Ensemble& ensemble,
               const TrialObserver& observer, const std::atomic<bool>* cancel,
               const Scaling& scaling, SmoothProgram* program);

  /// @throws InputError for a start at which a number of the study or a constraint is not finite.
  void start(const Eigen::VectorXd& rho);
  /// Evaluates a trial point; last() is then this point. False if the search was interrupted and
  /// must end.
  bool evaluate(const Eigen::VectorXd& rho, Derivatives derivatives);
  /// Sets the status and the termination, with the margins and warnings of the best point. @param
  /// failure why the algorithm gave up, if result().termination says that it did.
  void conclude(const std::string& failure);

  const EnsembleEvaluation& last() const { return last_; }
  const Eigen::VectorXd& last_rho() const { return last_rho_; }
  OptimizationResult& result() { return result_; }
  bool have_best() const { return have_best_; }
  /// Why the first trial point could not be evaluated, if none could.
  const Status& first_failure() const { return first_failure_; }
  /// The residual of the optimality conditions at the best point over the same at the start, and
  /// over the scale of (24j).
  double slope_left();
  double stationarity();
  /// Whether the search may end here.
  bool is_stationary() { return stationarity() <= most_stationarity(options_); }
  /// Evaluates the objective beside a stationary best point, where its slope tells nothing: to both
  /// sides along the directions in which the residuals do not change to first order, and of
  /// parameters without influence; doc/theory.md (24i). The directions that are flat are kept for
  /// the result. @returns whether a lower point was found, at a saddle; it is then the best one.
  bool finds_lower_point();
  /// Largest violation of a constraint at the best point, beyond its tolerance; 0 if all
  /// constraints are met.
  double best_violation() const { return best_violation_; }
  /// Whether the best point keeps all constraints, each within its tolerance.
  bool best_keeps_bounds();
  /// The watched signals of the best point; empty without one.
  const std::vector<WatchedResult>& watched_at_best();
  const ParameterRows& parameter_rows() const { return parameter_rows_; }
  /// The scaling by which stops are judged: it differs from that of the search in the ranges of
  /// parameters without bounds, which follow from the slopes that the search has met, (24j).
  const Scaling& judged_scaling();
  /// Whether the search was cancelled, or an evaluation was lost with its worker.
  bool interrupted() const { return !interruption_.ok(); }

 private:
  Trial note(const EnsembleEvaluation& all, const Eigen::VectorXd& rho);
  void note_influences(const Eigen::MatrixXd& gradients);
  void note_slopes(const Eigen::MatrixXd& gradients);
  void note_reaches(const Evaluation& evaluation);
  void note_change(const EnsembleEvaluation& all, const Eigen::VectorXd& rho);
  double violation(const EnsembleEvaluation& all, const Eigen::VectorXd& rho) const;
  void judge_end(const std::string& failure);
  void take_best(const EnsembleEvaluation& all, const Eigen::VectorXd& rho);
  double scale();
  const Optimality& best_optimality();
  Optimality optimality_at(const EnsembleEvaluation& all, const Eigen::VectorXd& rho);
  void judge_stop();
  /// What lies beside the best point along a direction.
  enum class Beside { kLower, kSame, kChanged };
  struct Side;
  struct Flat {
    Eigen::VectorXd step, design;
  };
  /// @param share the step in the unit of the parameter that moves most. @param flat if the result
  /// is kSame and not null: the step that was taken to one side, and the design there.
  Beside look_beside(const Eigen::VectorXd& direction, const Side& side, double share, Flat* flat);
  Beside look_at(const Eigen::VectorXd& step, const Side& side, double share, Flat* flat);
  Beside look_along_valley(Eigen::VectorXd rho, const Side& side, double rise, double limit,
                           Flat* flat);
  bool has_lower_along_flat();
  double mean_at(const EnsembleEvaluation& at) const;
  double same_within(const Eigen::VectorXd& step);
  Eigen::VectorXd extents() const;
  Eigen::VectorXd sizes();
  std::string find_unjudged() const;

  const Study& study_;
  const OptimizerOptions& options_;
  const Ensemble& ensemble_;
  const TrialObserver& observer_;
  const std::atomic<bool>* cancel_;
  const Scaling& scaling_;
  Scaling judged_;  ///< judged_scaling() of the best point, once its optimality was asked for
  Eigen::VectorXd reaches_;  ///< the least |psi / psi_rho| so far; infinite without a slope
  SmoothProgram& program_;
  const ParameterRows parameter_rows_;
  Eigen::VectorXd last_rho_;
  EnsembleEvaluation last_, best_, initial_;
  // Of `best_`, once they were asked for.
  std::optional<Optimality> best_optimality_;
  std::optional<std::vector<WatchedResult>> best_watched_;
  std::optional<double> initial_slope_;
  /// By tuned parameter: whether a derivative was other than zero anywhere, and whether the
  /// objective has changed with it alone.
  std::vector<bool> slopes_, changes_;
  bool differs_beside_ = false;  ///< whether look_at() saw a change that counts
  bool looked_beside_ = false;
  OptimizationResult result_;
  EventChanges event_changes_;
  Warnings lost_branches_;  ///< the first `branch_lost` of all trial points
  Status first_failure_{StatusCode::kNonFinite, 0.0, "no trial point could be evaluated"},
      interruption_;
  bool have_best_ = false;
  double best_violation_ = 0.0;
};

}  // namespace codesign
