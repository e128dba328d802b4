// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "mechanism_codesign/gradient.h"
#include "mechanism_codesign/optimizer_options.h"

namespace codesign {

/// One trial point of an optimization, theory (24). Vectors have one entry per tuned parameter,
/// order of Problem::tuned_names().
struct Trial {
  int evaluation = 0;  ///< number of the evaluation, from 1
  int iteration = 0;   ///< how often the best point has improved so far
  /// not ok: the point could not be assembled or integrated; the search turns back from it
  Status status;
  double objective = 0.0;      ///< psi; not valid if the status is not ok
  double gradient_norm = 0.0;  ///< norm of the gradient by the scaled variables x of (24)
  Eigen::VectorXd gradient;    ///< psi_rho
  Eigen::VectorXd rho;         ///< the trial point
  /// number of the search in a study with several starts, from 1, in the order in which the
  /// searches began
  int start = 0;
  /// at the best point so far; a point that violates the constraints less is better
  double best_objective = 0.0;
  /// largest violation of a constraint at that point, beyond its tolerance; 0 if all constraints
  /// are met
  double best_violation = 0.0;
  std::int64_t events = 0;  ///< number of events in the runs at the trial point
};

/// Called after each trial point; returning false ends the search with kCancelled and the best
/// point so far.
using TrialObserver = std::function<bool(const Trial&)>;

/// The objective of one run at one sample of the uncertain quantities, before and after the
/// optimization.
struct ScenarioResult {
  std::string run;      ///< name of the run; empty if the study has none
  int sample = -1;      ///< number of the sample from 0; -1: the nominal values
  double weight = 1.0;  ///< w; the sum over all scenarios is 1
  /// the parameters that the run or the sample sets
  std::vector<std::pair<std::string, double>> values;
  double initial_objective = 0.0, objective = 0.0;  ///< psi at the start and the best point
  /// the law of all joints if the study varies it; empty: the laws of the model
  std::string friction_law{};
  /// Whether the run failed at the start and at the best point. A failed run counts with the
  /// largest objective of the runs that did not fail.
  bool initial_failed = false, failed = false;
};

/// The best point on samples that the search has not seen.
struct Validation {
  int samples = 0;  ///< fresh samples of each run
  /// scenarios that could not be integrated; the members below leave them out, except `promised`
  /// and `within`
  int failed = 0;
  double promised = 0.0;   ///< the measure on the samples of the search
  double objective = 0.0;  ///< the same measure on the fresh samples
  double mean = 0.0, worst = 0.0;
  /// for the measure cvar: the value that fresh samples exceed with a probability of at most 1 -
  /// level
  double value_at_risk = 0.0;
  /// for the measure cvar: share of all fresh samples that do not exceed
  /// EnsembleResult::value_at_risk
  double within = 0.0;
};

/// One local search of several.
struct StartResult {
  Eigen::VectorXd start, rho;
  double start_objective = 0.0, objective = 0.0;  ///< at `start` and `rho`
  Status status;
  std::string termination;
  int evaluations = 0;
  int optimum = -1;  ///< index in MultistartResult::optima; -1: the search found none
};

/// A point at which one or several searches ended.
struct Optimum {
  Eigen::VectorXd rho;
  double objective = 0.0;
  int found = 0;  ///< number of searches that ended at this point
};

/// A signal that a constraint or a peak reads, over all scenarios; doc/theory.md (21a).
struct WatchedResult {
  std::string element, signal;  ///< its place in the study, `path[0]`, and the signal as written
  double initial_smallest = 0.0, initial_largest = 0;  ///< signal minus reference at the start
  double smallest = 0.0, largest = 0.0;                ///< at the best point
  double smallest_time = 0.0, largest_time = 0.0;      ///< [s]
  /// largest violation of the bounds at the best point; 0 if they are met, and for peaks
  double violation = 0.0;
  /// index of the scenario in EnsembleResult::scenarios
  int smallest_scenario = 0, largest_scenario = 0;
  /// The bounds, computed at the best point and the nominal values of the other parameters;
  /// infinite where the study gives none, and for peaks in the objective.
  double lower = -std::numeric_limits<double>::infinity(),
         upper = std::numeric_limits<double>::infinity();
  /// the interval in which the signal is watched [s]; for `final` the end of the run
  double after = 0.0, before = 0.0;
  /// The violation up to which the bounds count as met: the study's, or 1e-5 of the largest
  /// magnitude of the signal at the best point and of its bounds, at least 1e-8.
  double tolerance = 1e-8;
};

/// A design, in the order of Problem::tuned_names(), and what was computed there.
struct DesignPoint {
  Eigen::VectorXd rho;
  double objective = 0.0;    ///< psi
  Eigen::VectorXd gradient;  ///< psi_rho
  /// The residual of the optimality conditions in the unit of psi, theory (24j); not a number
  /// without a point.
  double slope = std::numeric_limits<double>::quiet_NaN();
  // For a study with runs or uncertain parameters, else empty:
  Eigen::VectorXd values;   ///< psi of each scenario
  std::vector<int> failed;  ///< indices of the scenarios that could not be integrated
  Events events;            ///< of the run there, Evaluation::events
};

/// How near the best point is to an optimum, and what holds it there.
struct OptimalityResult {
  double stationarity = std::numeric_limits<double>::quiet_NaN();  ///< the slope relative to psi
  /// Per tuned parameter: by how much psi falls, to first order, if the bound on which it lies is
  /// moved outwards by the range of the parameter, or without one by its extent, theory (24j);
  /// positive at the lower, negative at the upper bound, 0 off the bounds.
  Eigen::VectorXd bound_multipliers;
  /// Steps along which psi does not change, by rho, one per column: what moves one parameter by a
  /// hundredth of its range, in a curved valley to first order; theory (24i).
  Eigen::MatrixXd flat_directions;
  /// the designs beside the best one, as good as it, to which they lead, one per column
  Eigen::MatrixXd flat_points;
  /// Why no slope tells whether the best point is an optimum, as a part of a sentence: psi jumps
  /// with parameters, theory (24k). Empty: the slope tells it; else `stationarity` is not a number.
  std::string unjudged;
  /// per tuned parameter: whether the objective or a watched signal depended on it at any trial
  /// point
  std::vector<bool> influences;
  /// Whether differences of the objective through other steps confirm the gradient at the best
  /// point; not computed for postures, and where the search was interrupted or ended outside its
  /// constraints.
  IndependentCheck independent;
};

/// The constraints at the best point.
struct ConstraintResults {
  Eigen::VectorXd margins;  ///< of the study's parameter constraints; negative where violated
  std::vector<WatchedResult> watched;  ///< signals with constraints, then peaks; empty without any
};

/// What a search took.
struct SearchCost {
  int iterations = 0;
  int evaluations = 0;
  int failed_evaluations = 0;
  /// sums over all evaluations; drift and energy error are the largest of any evaluation
  Statistics statistics;

  SearchCost& operator+=(const SearchCost& other) {
    iterations += other.iterations;
    evaluations += other.evaluations;
    failed_evaluations += other.failed_evaluations;
    statistics += other.statistics;
    return *this;
  }
};

/// Of a study with runs or uncertain parameters; else empty.
struct EnsembleResult {
  std::vector<ScenarioResult> scenarios;
  /// for the measure cvar: the value at risk on the samples of the search
  std::optional<double> value_at_risk;
  std::optional<Validation> validation;  ///< if `robust.validate` requests it
};

/// Of a study with several starts; else empty.
struct MultistartResult {
  std::vector<StartResult> starts;  ///< the searches, best start first
  std::vector<Optimum> optima;      ///< best first
  /// number of points evaluated to choose the starts, and of these the number of failed points
  int screened = 0, unusable = 0;
};

/// Of a study with parameters that are chosen from lists or whole numbers; else empty. Theory
/// (24n).
struct ChoiceResult {
  /// Per list its name and what was chosen: the label of the row, or its numbers.
  std::vector<std::pair<std::string, std::string>> chosen;
  double combinations = 0.0;  ///< number of all
  int searched = 0;           ///< combinations at which a search of the other parameters has ended
  int unfinished = 0;   ///< of these: searches that ended before an optimum, or without a point
  int relaxations = 0;  ///< searches of parts of the combinations with numbers between the listed
  /// parts left out since their relaxation was worse than the best combination known
  int bounded = 0;
  int infeasible = 0;        ///< parts left out since their relaxation met no constraints
  bool is_complete = false;  ///< whether each combination was searched or left out
};

/// The best point of an optimization and how the search ended.
struct OptimizationResult {
  /// Ok; kCancelled; kAlgorithmFailed; kInfeasible if no point that meets the constraints was
  /// found; or, if the start value could not be evaluated, the status of that evaluation. Only in
  /// the last case the members below hold no point.
  Status status;
  /// why the search ended, in snake case: "objective_tolerance_reached", "max_evaluations_reached",
  /// "cancelled", ...; "stopped_early" if its algorithms ended at a point that is not stationary,
  /// or where differences of the objective refute the gradient
  std::string termination;
  /// that searched; of `auto` all that went on with the search, in their order, with commas
  std::string algorithm;
  DesignPoint initial;
  DesignPoint best;  ///< the best feasible point seen
  OptimalityResult optimality;
  ConstraintResults constraints;
  SearchCost cost;
  EnsembleResult ensemble;
  MultistartResult multistart;
  ChoiceResult choice;
  /// about the best point, and about the search: a parameter without influence or on its bound
  Warnings warnings;
};

/// The result in words: a table of the design, the objective, constraints and scenarios, how the
/// search ended, what it took, and the warnings; lines as `codesign optimize` prints them.
std::string report(const Problem& problem, const OptimizationResult& result);

/// Minimizes psi(rho) within the bounds and the parameter constraints, from the parameters' start
/// values.
/// @param options in place of Problem::optimizer_options().
/// @param cancel the search ends with kCancelled and the best point so far soon after this is set,
/// from any thread; null: never.
/// @throws InputError for options that contradict each other, such as constraints with an algorithm
/// that takes none.
OptimizationResult optimize(const Problem& problem, const TrialObserver& observer = {},
                            const std::atomic<bool>* cancel = nullptr);
OptimizationResult optimize(const Problem& problem, const OptimizerOptions& options,
                            const TrialObserver& observer = {},
                            const std::atomic<bool>* cancel = nullptr);

}  // namespace codesign
