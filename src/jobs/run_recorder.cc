// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "jobs/run_recorder.h"

#include <algorithm>

namespace codesign {

RunSummary record_run(const Problem& problem, const std::vector<double>& parameters, const std::vector<SignalDescription>& signals,
                      int samples, const RowSink& sink, const std::atomic<bool>* cancel) {
  Simulation simulation(problem.system(), parameters, signals);
  LimitWatch watch(problem, parameters, simulation.names());
  std::vector<double> row;
  const auto observer = [&](const Frame& frame) {
    watch.observe(frame);
    row.assign(1, frame.time);
    row.insert(row.end(), frame.signals.begin(), frame.signals.end());
    sink(row);
    return true;
  };
  RunSummary summary;
  summary.status = codesign::simulate(&simulation, problem.study().duration, samples, observer, cancel);
  summary.statistics = simulation.statistics();
  summary.methods = simulation.methods();
  summary.warnings = simulation.warnings();
  const Study& study = problem.study();
  const bool has_peak = std::any_of(study.watched.begin(), study.watched.end(),
                                    [](const WatchedSignal& watched) { return watched.role == WatchedSignal::Role::kPeak; });
  if (summary.status.ok() && has_objective(study) && !has_peak && simulation.time() == study.duration)
    summary.objective = simulation.objective();
  summary.crossings = watch.crossings();
  return summary;
}

std::vector<std::string> column_names(const std::vector<SignalDescription>& signals) {
  std::vector<std::string> names = {"time"};
  for (const SignalDescription& signal : signals) names.push_back(signal.text);
  return names;
}

}  // namespace codesign
