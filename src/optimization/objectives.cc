// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "optimization/objectives.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "description/parameter_switches.h"
#include "math/arrays.h"
#include "optimization/local_search.h"
#include "optimization/search_hooks.h"
#include "problem/load_problem.h"
#include "sampling/measure.h"

namespace codesign {
namespace {

/// The studies of all objectives as one, for what a search asks of a study.
Study joined(const Problem& problem, const std::vector<Problem>& objectives) {
  Study study = study_of(problem);
  for (const Problem& one : objectives) {
    const Study& of = study_of(one);
    study.integral.insert(study.integral.end(), of.integral.begin(), of.integral.end());
    study.terminal.insert(study.terminal.end(), of.terminal.begin(), of.terminal.end());
    study.switches.insert(study.switches.end(), of.switches.begin(), of.switches.end());
    for (const WatchedSignal& watched : of.watched)
      if (is_term(watched)) study.watched.push_back(watched);
  }
  return study;
}

}  // namespace

Objectives::Objectives(const Problem& problem, const std::atomic<bool>* cancel) : cancel_(cancel) {
  for (std::size_t k = 0; k < study_of(problem).tradeoff.size(); ++k) {
    problems_.push_back(objective_of(problem, k));
    for (Scenario& scenario : make_scenarios(problems_.back())) {
      scenario.repeats_bounds = k > 0;
      owners_.push_back(k);
      scenarios_.push_back(std::move(scenario));
    }
  }
  for (Scenario& scenario : scenarios_) scenario.weight /= static_cast<double>(problems_.size());
  worst_.measure = RobustMeasure::kWorst;
  if (study_of(problem).ensemble.robust_options().measure == RobustMeasure::kMean)
    worst_.groups.assign(owners_.begin(), owners_.end());
  engine_ = make_engine(study_of(problem).ensemble.engine, to_signed(scenarios_.size()));
  study_ = joined(problem, problems_);
}

OptimizationResult Objectives::search_alone(std::size_t objective) const {
  return run_search(problems_[objective], study_.optimizer, SearchHooks(), cancel_);
}

std::vector<Scenario> Objectives::scaled(const Eigen::VectorXd& offset,
                                         const Eigen::VectorXd& scale) const {
  std::vector<Scenario> scenarios = scenarios_;
  for (std::size_t s = 0; s < scenarios.size(); ++s) {
    scenarios[s].offset = offset[to_signed(owners_[s])];
    scenarios[s].scale = scale[to_signed(owners_[s])];
  }
  return scenarios;
}

OptimizationResult Objectives::search(const Eigen::VectorXd& start,
                                      const std::vector<Scenario>& scenarios) const {
  const Ensemble ensemble(scenarios, worst_, engine_);
  return search_locally(study_, study_.optimizer, start, ensemble, {}, cancel_);
}

bool Objectives::evaluate(TradeoffPoint* point) const {
  const Ensemble ensemble(scenarios_, worst_, engine_);
  const EnsembleEvaluation at = ensemble.evaluate(point->rho, false, cancel_);
  if (!at.total.status.ok()) {
    point->status = at.total.status;
    return false;
  }
  take_values(scenarios_, at.values, point);
  return true;
}

void Objectives::take_values(const std::vector<Scenario>& scenarios, const Eigen::VectorXd& values,
                             TradeoffPoint* point) const {
  point->objectives.setConstant(to_signed(count()), -std::numeric_limits<double>::infinity());
  Eigen::VectorXd psi(values.size()), weights(values.size());
  for (std::size_t s = 0; s < scenarios.size(); ++s) {
    psi[to_signed(s)] = scenarios[s].offset + scenarios[s].scale * values[to_signed(s)];
    weights[to_signed(s)] = scenarios[s].weight;
  }
  if (!worst_.groups.empty()) {
    point->objectives = grouped(worst_, psi, weights, nullptr);
    return;
  }
  for (std::size_t s = 0; s < scenarios.size(); ++s) {
    double& objective = point->objectives[to_signed(owners_[s])];
    objective = std::max(objective, psi[to_signed(s)]);
  }
}

void take_search(const OptimizationResult& found, TradeoffPoint* point) {
  point->rho = found.best.rho;
  point->status = found.status;
  point->termination = found.termination;
  point->stationarity = found.optimality.stationarity;
  point->cost += found.cost;
  for (const Warning& warning : found.warnings) point->warnings.push_back(warning.code);
}

Problem objective_of(const Problem& problem, std::size_t objective) {
  const Study& whole = study_of(problem);
  Study study = *whole.tradeoff[objective].study;
  study.parameters = whole.parameters;
  study.tuned = whole.tuned;
  study.optimizer = whole.optimizer;
  study.used_parameters = whole.used_parameters;
  study.initial_gains.clear();  // the start has them
  return with_study(problem, std::move(study));
}

}  // namespace codesign
