// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "optimization/multistart.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <utility>

#include "description/study.h"
#include "description/tuned_parameters.h"
#include "engine/thread_engine.h"
#include "ensemble/parameter_rows.h"
#include "math/arrays.h"
#include "optimization/confirmation.h"
#include "optimization/lagrangian.h"
#include "optimization/local_search.h"
#include "optimization/scaling.h"
#include "optimization/search_hooks.h"
#include "optimization/search_results.h"
#include "optimization/search_set.h"
#include "optimization/search_trials.h"
#include "optimization/smooth_program.h"
#include "optimization/worst_rounds.h"
#include "problem/load_problem.h"
#include "problem/margins.h"
#include "sampling/sampler.h"
#include "text/cancel.h"

namespace codesign {
namespace {

// Rounds of screening, after which unusable points are no longer replaced.
constexpr std::uint32_t kRounds = 10;
// Points that are in memory at the same time while screening, and at least 16 per worker.
constexpr int kPart = 1024;

/// A point that may become the start of a search.
struct Candidate {
  Eigen::VectorXd rho;
  double objective;
};

/// One search over starts: the state that its stages share.
class Multistart {
 public:
  Multistart(const Problem& problem, const OptimizerOptions& options, const SearchHooks& hooks,
             const std::atomic<bool>* cancel)
      : set_(problem, options, hooks, cancel, study_of(problem).ensemble.multistart.screen),
        asked_(set_.study.ensemble.multistart),
        parameter_rows_(set_.study, set_.ensemble.scenarios()),
        scaling_(set_.study) {}

  OptimizationResult run() {
    check_search(set_.study, set_.options, set_.ensemble);
    screen();
    std::vector<OptimizationResult> found = search();
    OptimizationResult result = combine(&found);
    result.multistart.screened = usable_ + unusable_;
    result.multistart.unusable = unusable_;
    result.cost.failed_evaluations += unusable_;
    if (set_.is_stopped()) {
      result.status = cancelled_search();
      result.termination = "cancelled";
    }
    // mpirun ends the job of a killed rank with the signal that a user's interrupt sends, too; the
    // status must name the killed rank.
    if (lost_.code == StatusCode::kWorkerLost) {
      result.status = lost_;
      result.termination = name_of(lost_.code);
    }
    return result;
  }

 private:
  /// Draws points until `screen` of them are usable: each round replaces the unusable points of the
  /// round before.
  void screen() {
    const int dimension = static_cast<int>(set_.study.tuned.size()),
              part = std::max(kPart, 16 * set_.ensemble.engine().workers());
    set_.meter.begin(SearchStage::kScreening, asked_.screen, set_.ensemble.scenarios().size());
    for (std::uint32_t round = 0; round < kRounds && missing() > 0 && goes_on(); ++round) {
      const int count = missing();
      const PointSequence fill =
          point_sequence(asked_.sampler, count, dimension, asked_.seed + round);
      for (int drawn = 0; drawn < count && goes_on(); drawn += part) {
        Eigen::MatrixXd unit(std::min(part, count - drawn), dimension);
        fill(&unit);
        std::vector<Eigen::VectorXd> points;
        for (Eigen::Index k = 0; k < unit.rows(); ++k)
          points.push_back(k + drawn == 0 && round == 0 ? set_.problem.start()
                                                        : at(unit.row(k).transpose()));
        evaluate(points);
      }
    }
  }

  bool goes_on() const { return !is_set(set_.cancel) && lost_.ok(); }
  int missing() const { return asked_.screen - usable_; }

  /// A point of the unit cube within the bounds.
  Eigen::VectorXd at(const Eigen::VectorXd& u) const {
    Eigen::VectorXd rho(u.size());
    for (Eigen::Index k = 0; k < u.size(); ++k) {
      const Parameter& p = tuned_parameter(set_.study, k);
      rho[k] = p.lower + u[k] * (p.upper - p.lower);
    }
    return rho;
  }

  /// Evaluates points, counts the usable ones and keeps the best of all so far, of equal ones those
  /// drawn first.
  void evaluate(const std::vector<Eigen::VectorXd>& round) {
    std::vector<EnsembleEvaluation> results(round.size());
    side_by_side(round.size(), set_.ensemble.engine().workers(), [&](std::size_t k) {
      if (is_set(set_.cancel)) {
        results[k].total.status.code = StatusCode::kCancelled;
        return;
      }
      if (may_begin(set_.study, parameter_rows_.margins(round[k])))
        results[k] = set_.ensemble.evaluate(round[k], false, set_.cancel);
      if (results[k].values.size() > 0) set_.meter.count_point();
    });
    for (std::size_t k = 0; k < round.size(); ++k) {
      const Evaluation& total = results[k].total;
      statistics_ += total.statistics;
      if (total.status.code == StatusCode::kWorkerLost) lost_ = with_best_kept(total.status);
      if (total.status.is_interrupted()) continue;
      if (results[k].values.size() == 0) {
        ++unusable_;
        if (first_failure_.ok() && !total.status.ok()) first_failure_ = total.status;
        continue;
      }
      ++usable_;
      starts_.push_back({round[k], total.objective});
    }
    std::stable_sort(starts_.begin(), starts_.end(), [](const Candidate& a, const Candidate& b) {
      return a.objective < b.objective;
    });
    if (starts_.size() > to_index(asked_.starts)) starts_.resize(to_index(asked_.starts));
  }

  std::vector<OptimizationResult> search() {
    std::vector<OptimizationResult> found(starts_.size());
    set_.meter.begin(SearchStage::kSearching, static_cast<std::int64_t>(starts_.size()),
                     set_.ensemble.scenarios().size());
    side_by_side(starts_.size(), set_.ensemble.engine().workers(), [&](std::size_t k) {
      if (set_.is_stopped()) return;
      found[k] = search_locally(set_.study, set_.options, starts_[k].rho, set_.ensemble,
                                set_.observer.of(static_cast<int>(k) + 1), set_.cancel);
      set_.meter.end_search(found[k].cost.evaluations);
    });
    for (const OptimizationResult& one : found)
      if (one.status.code == StatusCode::kWorkerLost) lost_ = one.status;
    return found;
  }

  /// The best of the results, with the list of all searches.
  OptimizationResult combine(std::vector<OptimizationResult>* found) {
    std::vector<StartResult> starts;
    std::vector<std::vector<double>> scaled;
    for (std::size_t k = 0; k < found->size(); ++k) {
      starts.push_back(describe(starts_[k].rho, starts_[k].objective, (*found)[k]));
      scaled.push_back(scaling_.to_scaled(starts.back().rho));
    }
    std::vector<Optimum> optima = cluster_optima(scaled, asked_.cluster, &starts);
    OptimizationResult best = choose(found);
    add_sums(*found, &best);
    Ensemble ensemble = set_.ensemble;
    go_on(static_cast<int>(found->size()), &ensemble, &best);
    best.multistart.starts = std::move(starts);
    best.multistart.optima = std::move(optima);
    confirm_stop(set_.study, set_.options, ensemble, set_.cancel, &best);
    take_study_start(ensemble, &best);
    describe_scenarios(set_.problem, ensemble, set_.cancel, &set_.meter, &best);
    return best;
  }

  /// The rounds of a worst case have the evaluations of a search.
  void go_on(int start, Ensemble* ensemble, OptimizationResult* best) {
    const SearchCost sums = std::exchange(best->cost, SearchCost());
    add_worst_points(set_.problem, set_.study, set_.options, set_.observer.of(start), set_.cancel,
                     ensemble, best);
    best->cost.iterations += sums.iterations;
    best->cost.evaluations += sums.evaluations;
    best->cost.failed_evaluations += sums.failed_evaluations;
    best->cost.statistics += sums.statistics;
  }

  static StartResult describe(const Eigen::VectorXd& start, double objective,
                              const OptimizationResult& result) {
    if (result.cost.evaluations == 0)
      return {start,
              start,
              objective,
              objective,
              {StatusCode::kCancelled, 0.0, "cancelled before it began"},
              "not_started",
              0,
              -1};
    const bool has_point = result.best.gradient.size() > 0;
    return {start,
            has_point ? result.best.rho : start,
            objective,
            has_point ? result.best.objective : objective,
            result.status,
            result.termination,
            result.cost.evaluations,
            -1};
  }

  OptimizationResult choose(std::vector<OptimizationResult>* found) const {
    const OptimizationResult* best = nullptr;
    for (const OptimizationResult& result : *found) {
      if (result.best.gradient.size() == 0) continue;
      const bool met = meets_constraints(set_.study, result),
                 best_met = best && meets_constraints(set_.study, *best);
      if (!best || (met && !best_met) ||
          (met == best_met && result.best.objective < best->best.objective))
        best = &result;
    }
    if (best) return *best;
    OptimizationResult none;
    none.status = first_failure_.ok()
                      ? Status{StatusCode::kInfeasible, 0.0,
                               "no point that meets the constraints could be evaluated"}
                      : first_failure_;
    none.termination = "start_failed";
    none.initial.rho = none.best.rho = set_.problem.start();
    if (!starts_.empty()) {
      none.best.rho = starts_.front().rho;
      none.best.objective = starts_.front().objective;
    }
    none.constraints.margins = parameter_rows_.margins(none.best.rho);
    none.optimality.influences.assign(set_.study.tuned.size(), false);
    return none;
  }

  void add_sums(const std::vector<OptimizationResult>& found, OptimizationResult* best) const {
    best->cost.evaluations = usable_ + unusable_;
    best->cost.failed_evaluations = 0;
    best->cost.statistics = statistics_;
    for (const OptimizationResult& result : found) {
      best->cost.evaluations += result.cost.evaluations;
      best->cost.failed_evaluations += result.cost.failed_evaluations;
      best->cost.statistics += result.cost.statistics;
    }
  }

  /// The initial values in the result are the values at the study's start, if that can be
  /// evaluated.
  void take_study_start(const Ensemble& ensemble, OptimizationResult* best) const {
    if (best->best.gradient.size() == 0 || is_set(set_.cancel)) return;
    const EnsembleEvaluation start = ensemble.evaluate(set_.problem.start(), true, set_.cancel);
    if (!start.total.status.ok()) return;
    best->initial.rho = set_.problem.start();
    best->initial.objective = start.total.objective;
    best->initial.gradient = start.total.gradient;
    SmoothProgram program(ensemble);
    best->initial.slope =
        optimality(start, set_.problem.start(), scaling_, parameter_rows_, &program, set_.cancel)
            .slope;
    best->initial.values = start.values;
    best->initial.failed = start.failed;
  }

  SearchSet set_;
  const MultistartOptions& asked_;
  const ParameterRows parameter_rows_;
  const Scaling scaling_;
  std::vector<Candidate> starts_;  // the best usable points, best first
  int usable_ = 0, unusable_ = 0;
  Status first_failure_;
  Status lost_;  // kWorkerLost if an evaluation ended with this status
  Statistics statistics_;
};

}  // namespace

OptimizationResult search_from_many_starts(const Problem& problem, const OptimizerOptions& options,
                                           const SearchHooks& hooks,
                                           const std::atomic<bool>* cancel) {
  return Multistart(problem, options, hooks, cancel).run();
}

std::vector<Optimum> cluster_optima(const std::vector<std::vector<double>>& scaled, double distance,
                                    std::vector<StartResult>* starts) {
  std::vector<std::size_t> order(starts->size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [starts](std::size_t a, std::size_t b) {
    return (*starts)[a].objective < (*starts)[b].objective;
  });
  std::vector<Optimum> optima;
  std::vector<std::size_t> representatives;
  for (std::size_t k : order) {
    StartResult& start = (*starts)[k];
    if (!start.status.ok()) continue;
    const auto is_near = [&](std::size_t other) {
      double largest = 0.0;
      for (std::size_t c = 0; c < scaled[k].size(); ++c)
        largest = std::max(largest, std::abs(scaled[k][c] - scaled[other][c]));
      return largest <= distance;
    };
    const auto known = std::find_if(representatives.begin(), representatives.end(), is_near);
    start.optimum = static_cast<int>(known - representatives.begin());
    if (known == representatives.end()) {
      representatives.push_back(k);
      optima.push_back({start.rho, start.objective, 0});
    }
    ++optima[to_index(start.optimum)].found;
  }
  return optima;
}

}  // namespace codesign
