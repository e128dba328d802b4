// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "optimization/worst_rounds.h"

#include <cmath>
#include <string>
#include <utility>

#include "description/study.h"
#include "ensemble/worst_point.h"
#include "math/arrays.h"
#include "optimization/algorithm.h"
#include "optimization/local_search.h"
#include "optimization/search_trials.h"
#include "problem/load_problem.h"
#include "text/number_text.h"

namespace codesign {
namespace {

constexpr double kSamePromise = 1e-4;  // of the objective

class WorstRounds {
 public:
  WorstRounds(const Problem& problem, const Study& study, const OptimizerOptions& options,
              const TrialObserver& observer, const std::atomic<bool>* cancel, Ensemble* ensemble,
              OptimizationResult* result)
      : problem_(problem),
        study_(study),
        options_(options),
        observer_(observer),
        cancel_(cancel),
        ensemble_(*ensemble),
        result_(*result) {}

  void run() {
    for (int round = 0; is_promise(); ++round) {
      WorstPoint found =
          find_worst_point(problem_, ensemble_, result_.best.rho, result_.best.values, cancel_);
      result_.cost.statistics += found.statistics;
      if (!found.status.ok()) return interrupt(found.status);
      const double promised = result_.best.objective;
      if (!found.is_known || !(found.objective > promised + kSamePromise * std::abs(promised)))
        return;
      const int left = options_.max_evaluations - result_.cost.evaluations;
      if (round == kMostWorstRounds || left < 1) return warn_of(found);
      Ensemble more = ensemble_.with(std::move(found.scenario));
      if (!search_again(more, left)) return;
      ensemble_ = std::move(more);
    }
  }

 private:
  bool is_promise() const {
    return ensemble_.options().measure == RobustMeasure::kWorst &&
           result_.best.values.size() == to_signed(ensemble_.scenarios().size()) &&
           result_.best.failed.empty() && !result_.status.is_interrupted();
  }

  void interrupt(const Status& status) {
    result_.status = with_best_kept(status);
    result_.termination = name_of(status.code);
  }

  void warn_of(const WorstPoint& found) {
    std::string at;
    for (const auto& [parameter, value] : found.scenario.values)
      at += (at.empty() ? "" : ", ") + study_.parameters[to_index(parameter)].name + " " +
            readable(value);
    append({warn("worst_between_samples",
                 {ensemble_.options().where, "robust.measure",
                  "between the samples, at " + at +
                      ", the objective is larger than the worst case that the search has "
                      "minimized; allow more optimizer.max_evaluations or robust.samples",
                  readable(found.objective), "at most " + readable(result_.best.objective)})},
           &result_.warnings);
  }

  /// @returns false if the search has no point, and the result is as before.
  bool search_again(const Ensemble& more, int evaluations) {
    OptimizerOptions rest = options_;
    rest.max_evaluations = evaluations;
    const SearchCost before = result_.cost;
    const TrialObserver counted = [&](Trial trial) {
      trial.evaluation += before.evaluations;
      trial.iteration += before.iterations;
      return !observer_ || observer_(trial);
    };
    OptimizationResult again =
        search_locally(study_, rest, result_.best.rho, more, counted, cancel_);
    if (again.best.gradient.size() == 0) return false;
    const EnsembleEvaluation start = more.evaluate(result_.initial.rho, true, cancel_);
    take_start(start, &again);
    again.cost.evaluations += before.evaluations;
    again.cost.failed_evaluations += before.failed_evaluations;
    again.cost.iterations += before.iterations;
    again.cost.statistics += before.statistics;
    again.cost.statistics += start.total.statistics;
    if (result_.algorithm != again.algorithm)
      again.algorithm = result_.algorithm + ", " + again.algorithm;
    for (std::size_t k = 0; k < again.optimality.influences.size(); ++k)
      if (result_.optimality.influences[k]) again.optimality.influences[k] = true;
    result_ = std::move(again);
    return true;
  }

  void take_start(const EnsembleEvaluation& start, OptimizationResult* again) const {
    const double slope = result_.initial.slope;
    if (start.total.status.ok()) {
      again->initial.rho = result_.initial.rho;
      again->initial.objective = start.total.objective;
      again->initial.gradient = start.total.gradient;
      again->initial.values = start.values;
      again->initial.failed = start.failed;
    }
    again->initial.slope = slope;
  }

  const Problem& problem_;
  const Study& study_;
  const OptimizerOptions& options_;
  const TrialObserver& observer_;
  const std::atomic<bool>* cancel_;
  Ensemble& ensemble_;
  OptimizationResult& result_;
};

}  // namespace

void add_worst_points(const Problem& problem, const Study& study, const OptimizerOptions& options,
                      const TrialObserver& observer, const std::atomic<bool>* cancel,
                      Ensemble* ensemble, OptimizationResult* result) {
  WorstRounds(problem, study, options, observer, cancel, ensemble, result).run();
}

}  // namespace codesign
