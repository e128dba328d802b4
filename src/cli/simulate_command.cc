// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <optional>

#include "assembly/reaction_advice.h"
#include "cli/commands.h"
#include "cli/inputs.h"
#include "cli/report.h"
#include "cli/series.h"
#include "description/study.h"
#include "description/tuned_parameters.h"
#include "jobs/json.h"
#include "jobs/record_json.h"
#include "jobs/run_fields.h"
#include "jobs/run_recorder.h"
#include "problem/load_problem.h"
#include "text/number_text.h"

namespace codesign::cli {
namespace {

/// Samples of signals may cost as much as the run.
std::string samples_text(const RunSummary& run) {
  return readable(run.sample_seconds, 2) + " s for the samples";
}

void summarize(const RunSummary& run, const Problem& problem, std::ostream& err) {
  if (study_of(problem).postures > 0) {
    err << "assembled " << study_of(problem).postures << " postures, "
        << readable(run.statistics.cpu_seconds) << " s of processor time, " << samples_text(run)
        << ", set-up " << readable(problem.setup_seconds()) << " s" << std::endl;
    for (const LimitCrossing& crossing : run.crossings) err << describe(crossing) << std::endl;
    return;
  }
  const double setup_seconds = problem.setup_seconds();
  err << "simulated " << readable(run.end) << " s in " << run.statistics.steps << " steps ("
      << run.statistics.rejected_steps << " rejected), " << readable(run.statistics.cpu_seconds)
      << " s of processor time, " << samples_text(run) << ", set-up " << readable(setup_seconds)
      << " s" << std::endl;
  err << "energy error " << readable(run.statistics.energy_error, 3)
      << " of the largest energy; constraint drift at most "
      << readable(run.statistics.constraint_drift, 3) << " times the error tolerance" << std::endl;
  if (run.events.count > 0)
    err << run.events.count << (run.events.count == 1 ? " event" : " events")
        << ", the first one at t = " << readable(run.events.list[0].time)
        << " s: " << describe(run.events.list[0]) << std::endl;
  for (const LimitCrossing& crossing : run.crossings) err << describe(crossing) << std::endl;
}

/// Adds the objective. It is that of the run, unless it has peaks or measures, which need a
/// separate run that follows them. If that run fails, `status` becomes its status.
/// @param as_searched integrates as a search does, so that the objective of a result is reproduced:
/// sensitivities take part in the error test of a search.
void add_objective(const Problem& problem, bool as_searched, const std::optional<double>& of_run,
                   const Console& console, Status* status, Json* object) {
  if (!status->ok() || !has_objective(study_of(problem))) return;
  const Study& study = study_of(problem);
  const bool with_gradient = as_searched && !study.tuned.empty() && !find_rounded(study);
  if (of_run && std::isfinite(*of_run) && !with_gradient) {
    (*object)["objective"] = *of_run;
    return;
  }
  const Evaluation evaluation =
      Evaluator(problem).evaluate(problem.start(), with_gradient, &console.cancel);
  if (evaluation.status.ok())
    (*object)["objective"] = evaluation.objective;
  else
    *status = evaluation.status;
}

void add_run(const Problem& problem, const RunSummary& run, const Json& counts, Json series,
             Json* object) {
  (*object)["parameters"] = parameters_json(problem, problem.parameters());
  if (study_of(problem).postures == 0) (*object)["end_time"] = run.end;
  add_statistics(run.statistics, object);
  (*object)["sample_seconds"] = run.sample_seconds;
  (*object)["methods"] = records_json(run.methods);
  add_events(run.events, object);
  object->update(counts);
  (*object)["limits_exceeded"] = to_json(run.crossings);
  (*object)["machine_numbers"] = to_json(machine_numbers_of(problem, problem.parameters()));
  (*object)["series"] = std::move(series);
}

}  // namespace

int simulate(const Arguments& arguments, const Console& console) {
  const Problem problem = load(arguments, &console);
  const std::vector<SignalDescription> signals = select_signals(arguments, problem);
  SeriesOutput output(arguments, problem, column_names(signals), "the table of the run", console);
  const auto sink = [&](const std::vector<double>& row) { output.add(row); };
  // Counted before the run, so that a cancelled command ends without further work.
  Json counts = Json::object();
  if (arguments.json) add_counts(problem, problem.parameters(), &counts);
  RunSummary run =
      record_run(problem, problem.parameters(), signals, arguments.samples, sink, &console.cancel);
  if (run.status.ok()) summarize(run, problem, progress_of(arguments, console));
  Json object;
  if (arguments.json) {
    add_objective(problem, !arguments.result.empty(), run.objective, console, &run.status, &object);
    add_run(problem, run, counts, output.json(), &object);
  }
  Warnings warnings = run.warnings;
  append(warn_of_open_reactions(*system_of(problem), signals), &warnings);
  add_warnings(arguments, problem, warnings, &object, console);
  return finish(arguments, run.status, std::move(object), console);
}

}  // namespace codesign::cli
