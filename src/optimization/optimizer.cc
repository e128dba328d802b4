// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "description/tuned_parameters.h"
#include "equations/compiled_system.h"
#include "mechanism_codesign/optimization.h"
#include "optimization/local_search.h"
#include "optimization/multistart.h"
#include "optimization/scenario_results.h"
#include "optimization/search_hooks.h"

namespace codesign {

OptimizationResult optimize(const std::shared_ptr<const CompiledSystem>& system, const OptimizerOptions& options,
                            const TrialObserver& observer, const std::atomic<bool>* cancel) {
  const Study& study = system->study();
  require_tuned(study);
  const Ensemble ensemble(system);
  return search_locally(study, options, start_of(study), ensemble, observer, cancel);
}

OptimizationResult optimize(const Problem& problem, const TrialObserver& observer, const std::atomic<bool>* cancel) {
  return optimize(problem, problem.optimizer_options(), observer, cancel);
}

OptimizationResult optimize(const Problem& problem, const OptimizerOptions& options, const TrialObserver& observer,
                            const std::atomic<bool>* cancel) {
  return run_search(problem, options, {observer, nullptr, nullptr}, cancel);
}

OptimizationResult run_search(const Problem& problem, const OptimizerOptions& options, const SearchHooks& hooks,
                              const std::atomic<bool>* cancel) {
  require_tuned(problem.study());
  if (problem.study().ensemble.multistart.starts > 0) return search_from_many_starts(problem, options, hooks, cancel);
  ProgressMeter own_meter(options.max_evaluations, hooks.progress);
  ProgressMeter* const meter = hooks.meter ? hooks.meter : &own_meter;
  const Ensemble ensemble(problem, 1, records_of(hooks, meter));
  meter->begin(SearchStage::kSearching, 0, ensemble.scenarios().size());
  const TrialObserver observer = counted_trials(hooks, meter);
  OptimizationResult result = search_locally(problem.study(), options, problem.start(), ensemble, observer, cancel);
  describe_scenarios(problem, ensemble, cancel, meter, &result);
  return result;
}

}  // namespace codesign
