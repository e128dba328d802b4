// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include <mutex>
#include <optional>

#include "cli/commands.h"
#include "cli/inputs.h"
#include "cli/job_folder.h"
#include "cli/progress_line.h"
#include "cli/report.h"
#include "description/study.h"
#include "description/tuned_parameters.h"
#include "engine/dispatcher.h"
#include "jobs/json.h"
#include "jobs/optimization_records.h"
#include "jobs/setpoint_bounds.h"
#include "jobs/trial_lines.h"
#include "math/arrays.h"
#include "optimization/result_report.h"
#include "optimization/search_hooks.h"
#include "problem/load_problem.h"

namespace codesign::cli {
namespace {

void print_lines(const std::vector<std::string>& sentences, const Console& console) {
  for (const std::string& sentence : sentences)
    console.err << "codesign optimize: " << sentence << std::endl;
}

/// A sentence if more processes were started than can have work.
std::vector<std::string> idle_ranks(const Problem& problem, const Dispatcher* ranks) {
  const EnsembleDescription& ensemble = study_of(problem).ensemble;
  if (ranks == nullptr || ranks->ranks() == 1 || ensemble.is_ensemble() ||
      ensemble.multistart.starts > 0)
    return {};
  return {"a study with one run and one start has one evaluation at a time: of the " +
          std::to_string(ranks->ranks()) + " processes that mpirun has started, one computes"};
}

}  // namespace

int optimize(const Arguments& arguments, const Console& console) {
  const Problem problem = load_tunable(arguments, &console);
  require_engine(study_of(problem).ensemble.engine, console.ranks);
  print_lines(idle_ranks(problem, console.ranks), console);
  std::optional<JobFolder> folder;
  if (!arguments.output.empty()) {
    folder.emplace(arguments.output, problem, arguments.resume);
    print_lines(folder->notes(), console);
  }
  std::mutex printing;  // progress comes from the workers
  LinePace stages, trials;
  std::ostream& shown = progress_of(arguments, console);
  const auto progress = [&](const Progress& so_far) {
    const std::lock_guard<std::mutex> lock(printing);
    if (stages.admits_now()) shown << progress_line(so_far) << std::endl;
  };
  ProgressMeter meter(problem.optimizer_options().max_evaluations, progress);
  TrialLines lines(study_of(problem));
  const auto observer = [&](const Trial& trial) {
    // Before the lock: the meter calls `progress`, which takes it.
    const Progress now = meter.now();
    const std::lock_guard<std::mutex> lock(printing);
    const std::string line = lines.line(trial, now);
    if (trials.admits_now()) shown << line << std::endl;
    if (folder) folder->add(trial);
    return !console.cancel;
  };
  const SearchHooks hooks{observer, nullptr, folder ? folder->journal() : nullptr, console.ranks,
                          &meter};
  const OptimizationResult result =
      run_search(problem, problem.optimizer_options(), hooks, &console.cancel);
  const bool designed = has_design(problem, result);
  if (!arguments.json && designed) console.out << outcome_text(problem, result);
  Json object = optimization_json(problem, result);
  Warnings warnings = result.warnings;
  if (result.status.code == StatusCode::kInfeasible)
    append(find_bounds_beyond_setpoints(problem, parameters_at(study_of(problem), result.best.rho),
                                        &console.cancel),
           &warnings);
  if (folder) append(folder->warnings(), &warnings);
  add_warnings(arguments, problem, warnings, &object, console);
  if (!result.status.ok()) object["error"] = to_json(result.status);
  if (result.status.code == StatusCode::kWorkerLost && folder)
    print_lines({"all that was evaluated is in the journal; go on with --resume " +
                 arguments.output + " in place of --output"},
                console);
  std::vector<Failure> failures;
  // The files are written before the output, so that the output reports missing ones.
  if (folder && designed) failures = folder->finish(object, result, console.cancel);
  return finish(arguments, result.status, std::move(object), console, failures);
}

}  // namespace codesign::cli
