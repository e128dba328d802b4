// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "python/jobs.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <functional>
#include <utility>

#include "description/study.h"
#include "description/tuned_parameters.h"
#include "engine/evaluation_engine.h"
#include "jobs/bag_files.h"
#include "jobs/identification_records.h"
#include "jobs/job_files.h"
#include "jobs/json_records.h"
#include "jobs/optimization_records.h"
#include "jobs/result_folder.h"
#include "jobs/tradeoff_records.h"
#include "jobs/trial_lines.h"
#include "math/arrays.h"
#include "mechanism/signal_catalog.h"
#include "mechanism_codesign/error.h"
#include "optimization/search_hooks.h"
#include "problem/load_problem.h"
#include "reading/study/study_values.h"
#include "text/number_text.h"

namespace codesign::python {
namespace {

constexpr const char* kConvergence = "convergence.csv";
constexpr const char* kFolder = "folder";

Json fields_of(const Problem& problem, const Trial& trial) {
  return {{"evaluation", trial.evaluation},
          {"iteration", trial.iteration},
          {"start", trial.start},
          {"status", to_json(trial.status)},
          {"objective", trial.objective},
          {"gradient_norm", trial.gradient_norm},
          {"best_objective", trial.best_objective},
          {"best_violation", trial.best_violation},
          {"events", trial.events},
          {"parameters", by_name(problem.tuned_names(), trial.rho)}};
}

Json fields_of(const Progress& progress) {
  constexpr std::array<const char*, 3> kStages{"screening", "searching", "validating"};
  Json fields = {{"stage", kStages[to_index(progress.stage)]},
                 {"done", progress.done},
                 {"of", progress.of},
                 {"runs", progress.runs}};
  fields["seconds_left"] = progress.seconds_left ? Json(*progress.seconds_left) : Json();
  return fields;
}

Json fields_of(const FitTrial& trial) {
  return {{"evaluation", trial.evaluation},
          {"iteration", trial.iteration},
          {"profile", trial.profile},
          {"status", to_json(trial.status)},
          {"cost", trial.cost},
          {"rms", by_name(trial.outputs, trial.rms)}};
}

void write_file(const std::string& folder, const std::string& name,
                const std::function<std::string()>& text, std::vector<Failure>* failures) {
  try {
    write_whole_file((std::filesystem::path(folder) / name).string(), text());
  } catch (const std::exception& error) {
    failures->push_back({"output_failed", error.what()});
  }
}

/// Values of parameters that the study does not tune, as `set:` of a recording names them.
std::vector<RecordedSetting> settings_of(const Study& study, const RecordedArrays& arrays) {
  std::vector<RecordedSetting> settings;
  for (const auto& [name, value] : arrays.settings) {
    const std::string element = arrays.element + ".set." + name;
    const int index = untuned_parameter(name, study, SourceLocation{"arrays", 0}, element);
    require_within_bounds(value, study.parameters[to_index(index)], {"arrays", 0}, element);
    settings.push_back({index, value});
  }
  return settings;
}

std::vector<RecordingDescription> descriptions_of(const Problem& problem,
                                                  const std::vector<RecordedArrays>& list) {
  const Study& study = study_of(problem);
  std::vector<RecordingDescription> descriptions;
  for (const RecordedArrays& arrays : list) {
    for (const SignalSamples& samples : arrays.signals) {
      const std::string element = arrays.element + ".signals";
      check_signal(samples.signal, robot_of(problem), study.controllers, element);
      require_known(samples.signal, names_of(study.parameters), samples.signal.where, element);
    }
    RecordingDescription& description = descriptions.emplace_back();
    description.file = "arrays";
    description.is_bag = true;  // read from memory
    description.element = arrays.element;
    description.where = {"arrays", 0};
    description.settings = settings_of(study, arrays);
    description.masks = arrays.masks;
    description.rest = arrays.rest;
    description.starts = arrays.starts;
  }
  return descriptions;
}

JointRecording recording_of(const RecordingDescription& of, const RecordingArrays& arrays) {
  const auto is_named = [&of](const RecordedArrays& each) { return each.element == of.element; };
  auto found = std::find_if(arrays.data.begin(), arrays.data.end(), is_named);
  if (found == arrays.data.end())
    found = std::find_if(arrays.holdout.begin(), arrays.holdout.end(), is_named);
  JointRecording recording;
  recording.file = of.file;
  recording.is_given = true;
  recording.times = found->times;
  for (std::size_t k = 0; k < found->times.size(); ++k) recording.places.push_back(k + 1);
  recording.joints = found->joints;
  recording.signals = found->signals;
  recording.element = of.element;
  recording.where = of.where;
  return recording;
}

/// The recordings that a study names, or arrays in place of them.
/// @param with_efforts whether joints that the study calibrates must have efforts in arrays
StudyRecordings recordings_of(const Problem& problem, const std::optional<RecordingArrays>& arrays,
                              bool with_efforts, Warnings* warnings,
                              const std::atomic<bool>* cancel) {
  const IdentificationDescription& identification = *study_of(problem).identification;
  if (!arrays) {
    const std::string folder =
        std::filesystem::absolute(problem.study_text().name).parent_path().string();
    return load_recordings(identification, robot_of(problem), folder, bag_files().read, warnings,
                           cancel);
  }
  IdentificationDescription given = identification;
  if (!with_efforts) given.joints.clear();
  given.data = descriptions_of(problem, arrays->data);
  given.holdout = descriptions_of(problem, arrays->holdout);
  const auto reader = [&arrays](const RecordingDescription& of, const std::string& /*path*/,
                                const std::vector<std::string>& /*joints*/,
                                Warnings* /*warnings*/) { return recording_of(of, *arrays); };
  return load_recordings(given, robot_of(problem), "/", reader, warnings, cancel);
}

/// A study without `identify:` has its defaults.
Problem identifiable(const Problem& problem, bool has_arrays, bool is_fitted) {
  if (study_of(problem).identification || !has_arrays) return problem;
  if (is_fitted) require_tuned(study_of(problem));
  Study study = study_of(problem);
  study.identification.emplace().where = {study.file, 1};
  return with_study(problem, std::move(study));
}

}  // namespace

Optimized optimize(const Problem& problem, const Tell& tell, const std::atomic<bool>* cancel) {
  require_objective(problem);
  require_tuned(study_of(problem));
  require_engine(study_of(problem).ensemble.engine, nullptr);
  Optimized optimized{problem, {}, {}, {}};
  const auto progress = [&tell](const Progress& so_far) {
    if (tell) tell(progress_line(so_far), fields_of(so_far));
  };
  ProgressMeter meter(problem.optimizer_options().max_evaluations, progress);
  TrialLines lines(study_of(problem));
  const auto observer = [&](const Trial& trial) {
    optimized.trials.push_back(trial);
    return !tell || tell(lines.line(trial, meter.now()), fields_of(problem, trial));
  };
  const SearchHooks hooks{observer, nullptr, nullptr, nullptr, &meter};
  optimized.result = run_search(problem, problem.optimizer_options(), hooks, cancel);
  optimized.json = optimization_report(problem, optimized.result, optimized.result.warnings);
  return optimized;
}

std::vector<Failure> write_folder(const Optimized& optimized, const std::string& folder,
                                  const std::atomic<bool>* cancel) {
  const Problem& problem = optimized.problem;
  std::vector<std::string> names = ResultFolder::file_names();
  names.emplace_back(kConvergence);
  make_folder(folder, kFolder);
  require_other_files(folder, names, kFolder, problem);
  const ResultFolder files(folder, problem);
  std::vector<Failure> failures = files.write_design(optimized.json, optimized.result);
  write_file(
      folder, kConvergence,
      [&] {
        std::vector<std::vector<std::string>> rows;
        rows.reserve(optimized.trials.size());
        for (const Trial& trial : optimized.trials) rows.push_back(convergence_row(trial));
        return csv_text(convergence_columns(problem.tuned_names()), rows, kConvergence);
      },
      &failures);
  const std::vector<Failure> of_runs = files.write_runs(optimized.result, cancel);
  failures.insert(failures.end(), of_runs.begin(), of_runs.end());
  return failures;
}

Traded tradeoff(const Problem& problem, int points, const Tell& tell,
                const std::atomic<bool>* cancel) {
  require_engine(study_of(problem).ensemble.engine, nullptr);
  std::vector<std::string> names;
  for (const TradeoffObjective& objective : study_of(problem).tradeoff)
    names.push_back(objective.name);
  const auto observer = [&](const TradeoffPoint& point, int done, int of) {
    if (!tell) return true;
    Json fields = point_json(problem, names, point);
    fields["done"] = done;
    fields["of"] = of;
    return tell(tradeoff_line(names, point, done, of), fields);
  };
  Traded traded{problem, find_tradeoff(problem, points, observer, cancel), {}};
  traded.json = tradeoff_report(problem, traded.result);
  return traded;
}

Identified identify(const Problem& problem, const std::optional<RecordingArrays>& arrays,
                    bool is_fitted, const Tell& tell, const std::atomic<bool>* cancel) {
  Identified identified{identifiable(problem, arrays.has_value(), is_fitted), {}, {}};
  if (is_fitted)
    require_identification(identified.problem);
  else
    require_recordings_named(identified.problem);
  Warnings warnings;
  const StudyRecordings recordings =
      recordings_of(identified.problem, arrays, true, &warnings, cancel);
  FitLines lines(problem.optimizer_options().max_evaluations);
  const auto observer = [&](const FitTrial& trial) {
    if (!tell) return true;
    const std::string line = lines.line(trial);
    return line.empty() || tell(line, fields_of(trial));
  };
  identified.result = is_fitted
                          ? codesign::identify(identified.problem, recordings, observer, cancel)
                          : evaluate_model(identified.problem, recordings, cancel);
  append(warnings, &identified.result.warnings);
  identified.json =
      identification_report(identified.problem, identified.result, identified.result.warnings);
  return identified;
}

Regressor regressor(const Problem& problem, const RecordingArrays& arrays,
                    const std::vector<double>& design, const std::atomic<bool>* cancel) {
  const Problem of = identifiable(problem, true, true);
  const Study& study = study_of(of);
  RecordingArrays at = arrays;
  for (RecordedArrays& recording : at.data)
    for (std::size_t k = 0; k < design.size(); ++k)
      if (std::find(study.tuned.begin(), study.tuned.end(), static_cast<int>(k)) ==
              study.tuned.end() &&
          design[k] != study.parameters[k].value &&
          std::none_of(recording.settings.begin(), recording.settings.end(),
                       [&](const auto& own) { return own.first == study.parameters[k].name; }))
        recording.settings.emplace_back(study.parameters[k].name, design[k]);
  const FitVariables variables(study, &robot_of(of));
  Eigen::VectorXd x = variables.start();
  for (std::size_t k = 0; k < study.tuned.size(); ++k)
    x[to_signed(k)] = design[to_index(study.tuned[k])];
  Warnings known_warnings;
  return find_regressor(of, x, recordings_of(of, at, false, &known_warnings, cancel).data, cancel);
}

std::vector<Failure> write_folder(const Identified& identified, const std::string& folder) {
  std::vector<Failure> failures;
  const std::vector<IdentificationFile> files =
      identification_files(identified.problem, identified.result, identified.json);
  std::vector<std::string> names;
  names.reserve(files.size());
  for (const IdentificationFile& file : files) names.push_back(file.name);
  make_folder(folder, kFolder);
  require_other_files(folder, names, kFolder, identified.problem);
  for (const IdentificationFile& file : files) write_file(folder, file.name, file.text, &failures);
  return failures;
}

}  // namespace codesign::python
