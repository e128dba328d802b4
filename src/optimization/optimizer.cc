// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "description/study.h"
#include "description/tuned_parameters.h"
#include "engine/dispatcher.h"
#include "equations/compiled_system.h"
#include "mechanism_codesign/optimization.h"
#include "optimization/choice_search.h"
#include "optimization/confirmation.h"
#include "optimization/local_search.h"
#include "optimization/multistart.h"
#include "optimization/search_hooks.h"
#include "optimization/search_results.h"
#include "optimization/search_set.h"
#include "optimization/search_trials.h"
#include "optimization/worst_rounds.h"
#include "problem/load_problem.h"

namespace codesign {

OptimizationResult optimize(const std::shared_ptr<const CompiledSystem>& system,
                            const OptimizerOptions& options, const TrialObserver& observer,
                            const std::atomic<bool>* cancel) {
  const Study& study = system->whole_study();
  require_tuned(study);
  const Ensemble ensemble(system);
  OptimizationResult result =
      search_locally(study, options, start_of(study), ensemble, observer, cancel);
  confirm_stop(study, options, ensemble, cancel, &result);
  return result;
}

OptimizationResult optimize(const Problem& problem, const TrialObserver& observer,
                            const std::atomic<bool>* cancel) {
  return optimize(problem, problem.optimizer_options(), observer, cancel);
}

OptimizationResult optimize(const Problem& problem, const OptimizerOptions& options,
                            const TrialObserver& observer, const std::atomic<bool>* cancel) {
  return run_search(problem, options, {observer, nullptr, nullptr}, cancel);
}

namespace {

OptimizationResult search_once(const Problem& problem, const OptimizerOptions& options,
                               const SearchHooks& hooks, const std::atomic<bool>* cancel) {
  SearchSet set(problem, options, hooks, cancel);
  set.meter.begin(SearchStage::kSearching, 0, set.ensemble.scenarios().size());
  OptimizationResult result =
      search_locally(set.study, options, problem.start(), set.ensemble, set.trial, cancel);
  add_worst_points(problem, set.study, options, set.trial, cancel, &set.ensemble, &result);
  confirm_stop(set.study, options, set.ensemble, cancel, &result);
  describe_scenarios(problem, set.ensemble, cancel, &set.meter, &result);
  return result;
}

}  // namespace

OptimizationResult run_search(const Problem& problem, const OptimizerOptions& options,
                              const SearchHooks& hooks, const std::atomic<bool>* cancel) {
  require_tuned(study_of(problem));
  OptimizationResult result = has_choices(study_of(problem))
                                  ? search_choices(problem, options, hooks, cancel)
                              : study_of(problem).ensemble.multistart.starts > 0
                                  ? search_from_many_starts(problem, options, hooks, cancel)
                                  : search_once(problem, options, hooks, cancel);
  if (result.status.code != StatusCode::kCancelled || hooks.ranks == nullptr) return result;
  // mpirun interrupts the job also when one of its ranks was killed, perhaps an idle one.
  const Status missed = hooks.ranks->call_roll();
  if (missed.ok()) return result;
  result.status = with_best_kept(missed);
  result.termination = name_of(missed.code);
  return result;
}

}  // namespace codesign
