// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "optimization/choice_search.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "description/study.h"
#include "description/tuned_parameters.h"
#include "math/arrays.h"
#include "optimization/algorithm.h"
#include "optimization/choice_parts.h"
#include "optimization/confirmation.h"
#include "optimization/lagrangian.h"
#include "optimization/local_search.h"
#include "optimization/scaling.h"
#include "optimization/search_results.h"
#include "optimization/search_set.h"
#include "optimization/search_trials.h"
#include "optimization/worst_rounds.h"
#include "problem/load_problem.h"
#include "text/cancel.h"

namespace codesign {
namespace {

using Eigen::VectorXd;

constexpr double kInfinite = std::numeric_limits<double>::infinity();

/// A part of the combinations, with the minimum of its relaxation.
struct Node {
  ChoicePart part;
  VectorXd rho;               ///< the minimum, or a design near it
  double bound = -kInfinite;  ///< objective there; less if it is not known
};

class ChoiceSearch {
 public:
  ChoiceSearch(const Problem& problem, const OptimizerOptions& options, const SearchHooks& hooks,
               const std::atomic<bool>* cancel)
      : set_(problem, options, hooks, cancel),
        space_{set_.study, choice_lists(set_.study)},
        whole_(all_rows(space_)) {
    choice_.combinations = 1.0;
    for (const auto& rows : whole_) choice_.combinations *= static_cast<double>(rows.size());
  }

  OptimizationResult run() {
    check_search(set_.study, set_.options, set_.ensemble);
    set_.meter.begin(SearchStage::kSearching,
                     static_cast<std::int64_t>(std::min(choice_.combinations, 1e9)),
                     set_.ensemble.scenarios().size());
    // The first search starts from the study's start, whose objective is the initial one.
    search_at(nearest_rows(space_, whole_, set_.problem.start()), set_.problem.start());
    if (choice_.combinations <= kMostListedCombinations)
      search_all();
    else
      branch();
    return conclude();
  }

 private:
  /// The study with the bounds of a part.
  Study bounded(const ChoicePart& part, VectorXd* rho) const {
    Study study = set_.study;
    for (std::size_t k = 0; k < space_.lists.size(); ++k)
      for (std::size_t c = 0; c < space_.lists[k].places.size(); ++c) {
        Parameter& parameter = study.parameters[to_index(space_.lists[k].choice->parameters[c])];
        parameter.lower = kInfinite;
        parameter.upper = -kInfinite;
        for (const std::size_t row : part[k]) {
          parameter.lower = std::min(parameter.lower, space_.lists[k].choice->rows[row][c]);
          parameter.upper = std::max(parameter.upper, space_.lists[k].choice->rows[row][c]);
        }
        double& value = (*rho)[space_.lists[k].places[c]];
        value = std::min(parameter.upper, std::max(parameter.lower, value));
        parameter.value = value;
      }
    return study;
  }

  /// Whether only what is chosen is tuned.
  bool is_all_chosen() const {
    std::size_t chosen = 0;
    for (const ChoiceList& list : space_.lists) chosen += list.places.size();
    return chosen == set_.study.tuned.size();
  }

  OptimizationResult search(const ChoicePart& part, VectorXd rho, bool is_real) {
    const Study study = bounded(part, &rho);
    const TrialObserver observer = set_.observer.of(++searches_, is_real);
    OptimizationResult result;
    if (is_real && is_all_chosen()) {
      const Scaling scaling(study);
      SmoothProgram program(set_.ensemble);
      SearchTrials trials(study, set_.options, set_.ensemble, observer, set_.cancel, scaling,
                          &program);
      trials.start(rho);
      trials.result().termination = "success";
      trials.evaluate(rho, Derivatives::kGradient);
      trials.conclude("");
      result = std::move(trials.result());
    } else {
      result = search_locally(study, set_.options, rho, set_.ensemble, observer, set_.cancel);
    }
    cost_ += result.cost;
    for (std::size_t k = 0; k < result.optimality.influences.size(); ++k)
      if (influences_.size() <= k)
        influences_.push_back(result.optimality.influences[k]);
      else if (result.optimality.influences[k])
        influences_[k] = true;
    if (result.status.is_interrupted()) interruption_ = result.status;
    set_.meter.end_search(result.cost.evaluations);
    return result;
  }

  bool goes_on() {
    if (interruption_.ok() && set_.is_stopped()) interruption_ = cancelled_search();
    return interruption_.ok();
  }

  /// (whether it violates constraints, objective); no point comes last.
  std::pair<int, double> rank(const OptimizationResult& result) const {
    if (result.best.gradient.size() == 0) return {2, kInfinite};
    return {meets_constraints(set_.study, result) ? 0 : 1, result.best.objective};
  }

  double best_objective() const {
    return best_ && rank(*best_).first == 0 ? best_->best.objective : kInfinite;
  }

  void search_at(const ChoicePart& part, const VectorXd& start) {
    if (!known_.insert(part).second) return;
    OptimizationResult found = search(part, start, true);
    // An interrupted search has a design, too.
    if (found.status.is_interrupted() && found.best.gradient.size() == 0) return;
    if (!found.status.is_interrupted()) {
      ++choice_.searched;
      const bool has_ended =
          found.status.code == StatusCode::kInfeasible || is_success(found.termination);
      if (!has_ended) ++choice_.unfinished;
    }
    if (!initial_) initial_ = found.initial;
    if (best_ && !(rank(found) < rank(*best_))) return;
    best_ = std::move(found);
    best_part_ = part;
  }

  /// Each search starts from the best design so far.
  void search_all() {
    std::vector<std::size_t> digits(space_.lists.size(), 0);
    for (bool is_left = true; is_left && goes_on();) {
      ChoicePart part;
      for (const std::size_t digit : digits) part.push_back({digit});
      search_at(part, best_ ? best_->best.rho : set_.problem.start());
      std::size_t k = 0;
      while (k < digits.size() && ++digits[k] == whole_[k].size()) digits[k++] = 0;
      is_left = k < digits.size();
    }
    choice_.is_complete = goes_on();
  }

  /// Differences within the tolerance of a search do not tell parts apart.
  bool is_worse(double bound) const {
    const double best = best_objective();
    return bound >= best - set_.options.relative_tolerance * std::abs(best);
  }

  /// Best first. The bound of a part is the minimum of its relaxation, if that search ended at a
  /// stationary point, else that of the part that it was split from.
  void branch() {
    std::vector<Node> open;
    add(whole_, {{}, set_.problem.start(), -kInfinite}, &open);
    while (!open.empty() && goes_on()) {
      const auto next = std::min_element(
          open.begin(), open.end(), [](const Node& a, const Node& b) { return a.bound < b.bound; });
      Node node = std::move(*next);
      open.erase(next);
      if (is_worse(node.bound)) {
        ++choice_.bounded;
        continue;
      }
      for (const ChoicePart& half : split_part(space_, node.part, node.rho)) {
        if (!goes_on()) return;
        add(half, node, &open);
      }
    }
    choice_.is_complete = goes_on();
  }

  void add(const ChoicePart& part, const Node& above, std::vector<Node>* open) {
    if (is_single(part)) return search_at(part, above.rho);
    OptimizationResult relaxed = search(part, above.rho, false);
    if (!goes_on()) return;
    ++choice_.relaxations;
    if (relaxed.status.code == StatusCode::kInfeasible) {
      ++choice_.infeasible;
      return;
    }
    Node node{part, above.rho, above.bound};
    if (relaxed.best.gradient.size() > 0) node.rho = relaxed.best.rho;
    if (relaxed.status.ok() && is_success(relaxed.termination))
      node.bound = std::max(above.bound, relaxed.best.objective);
    if (is_worse(node.bound)) {
      ++choice_.bounded;
      return;
    }
    search_at(nearest_rows(space_, part, node.rho), node.rho);
    open->push_back(std::move(node));
  }

  /// The best combination, with the sums over all searches.
  OptimizationResult conclude() {
    OptimizationResult result = best_ ? std::move(*best_) : OptimizationResult();
    if (!best_) {
      result.initial.rho = result.best.rho = set_.problem.start();
      result.optimality.influences.assign(set_.study.tuned.size(), false);
      result.status = interruption_;
    }
    if (result.best.gradient.size() > 0 && goes_on()) confirm(&result);
    result.choice = choice_;
    for (std::size_t k = 0; k < best_part_.size(); ++k)
      result.choice.chosen.emplace_back(space_.lists[k].choice->name,
                                        row_text(*space_.lists[k].choice, best_part_[k].front()));
    if (initial_) result.initial = *initial_;
    result.cost = cost_;
    forget_bounds(&result);
    if (!goes_on()) {
      result.status = interruption_;
      result.termination = name_of(interruption_.code);
    } else if (is_success(result.termination)) {
      result.termination = choice_.combinations <= kMostListedCombinations
                               ? "all_combinations_searched"
                               : "combinations_bounded";
    }
    return result;
  }

  void confirm(OptimizationResult* result) {
    VectorXd rho = result->best.rho;
    const Study study = bounded(best_part_, &rho);
    const SearchCost before = result->cost;
    add_worst_points(set_.problem, study, set_.options, set_.observer.of(searches_), set_.cancel,
                     &set_.ensemble, result);
    cost_.evaluations += result->cost.evaluations - before.evaluations;
    if (!is_all_chosen()) confirm_stop(study, set_.options, set_.ensemble, set_.cancel, result);
    describe_scenarios(set_.problem, set_.ensemble, set_.cancel, &set_.meter, result);
  }

  /// Multipliers of the bounds between which a search has fixed a parameter tell nothing.
  void forget_bounds(OptimizationResult* result) const {
    for (const ChoiceList& list : space_.lists)
      for (const auto place : list.places)
        if (result->optimality.bound_multipliers.size() > place)
          result->optimality.bound_multipliers[place] = 0.0;
    if (is_all_chosen()) result->optimality.stationarity = std::numeric_limits<double>::quiet_NaN();
    for (std::size_t k = 0; k < influences_.size(); ++k)
      result->optimality.influences[k] = influences_[k];
  }

  SearchSet set_;
  const ChoiceSpace space_;
  const ChoicePart whole_;
  std::set<ChoicePart> known_;  ///< combinations that were searched
  ChoiceResult choice_;
  SearchCost cost_;
  std::vector<bool> influences_;
  int searches_ = 0;
  std::optional<OptimizationResult> best_;
  std::optional<DesignPoint> initial_;
  ChoicePart best_part_;
  Status interruption_;
};

}  // namespace

bool has_choices(const Study& study) { return !choice_lists(study).empty(); }

OptimizationResult search_choices(const Problem& problem, const OptimizerOptions& options,
                                  const SearchHooks& hooks, const std::atomic<bool>* cancel) {
  return ChoiceSearch(problem, options, hooks, cancel).run();
}

}  // namespace codesign
