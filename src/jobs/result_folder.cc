// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "jobs/result_folder.h"

#include <unistd.h>
#include <filesystem>
#include <sstream>

#include "description/study.h"
#include "jobs/csv_writer.h"
#include "jobs/files.h"
#include "jobs/json.h"
#include "jobs/json_records.h"
#include "jobs/optimization_records.h"
#include "jobs/robot_gains.h"
#include "jobs/run_recorder.h"
#include "problem/load_problem.h"
#include "reading/urdf/floating_base.h"
#include "reading/urdf/urdf_reader.h"
#include "text/number_text.h"

namespace codesign {
namespace {

using Text = std::function<std::string()>;

void write_file(const std::string& path, const Text& text, std::vector<Failure>* failures) {
  try {
    write_whole_file(path, text());
  } catch (const std::exception& error) {
    failures->push_back({"output_failed", error.what()});
  }
}

/// The path in `folder` for a copy of a file that the study names; empty for an absolute path, or
/// if the path leads out of the folder.
std::string place_of(const LoadedFile& file, const std::string& folder) {
  const std::filesystem::path path = std::filesystem::path(file.file).lexically_normal();
  if (path.is_absolute() || path.empty() || *path.begin() == "..") return "";
  return (std::filesystem::path(folder) / path).string();
}

/// Copies a named file, so that job_study.yaml finds it in the folder, too. Never overwrites the
/// file that was read.
void write_named_file(const LoadedFile& file, const std::string& folder) {
  const std::string place = place_of(file, folder);
  std::error_code unknown;
  if (place.empty() || std::filesystem::equivalent(place, file.source.name, unknown)) return;
  std::filesystem::create_directories(std::filesystem::path(place).parent_path());
  write_whole_file(place, file.source.text);
}

}  // namespace

void BestRecord::note(const Trial& trial) {
  const bool better = trial.status.ok() && trial.iteration > iteration_;
  if (!better) return;
  if (iteration_ < 0) first_ = trial;
  iteration_ = trial.iteration;
  try {
    write_whole_file(
        prefix_ + "best.urdf",
        write_tuned_urdf(problem_.urdf(), problem_.overlays(), problem_.parameters(trial.rho),
                         std::nullopt, robot_of(problem_).laws));
    write_whole_file(prefix_ + "best.json", json(trial));
    failure_.clear();
  } catch (const std::exception& error) {
    failure_ = error.what();
  }
}

std::string BestRecord::json(const Trial& trial) const {
  Json object;
  object["model"] = robot_of(problem_).name;
  object["objective"] = trial.objective;
  object["initial_objective"] = first_.objective;
  object["parameters"] = parameters_json(problem_, problem_.parameters(trial.rho));
  object["initial_parameters"] = parameters_json(problem_, problem_.parameters(first_.rho));
  object["gradient"] = by_name(problem_.tuned_names(), trial.gradient);
  object["iterations"] = trial.iteration;
  object["evaluations"] = trial.evaluation;
  object["termination"] = "running";
  return to_text(object);
}

void BestRecord::remove() {
  for (const char* name : {"best.urdf", "best.json"}) unlink((prefix_ + name).c_str());
}

const std::vector<std::string>& ResultFolder::file_names() {
  static const std::vector<std::string> kNames = {
      "result.json", "details.json", "tuned.urdf", "initial.urdf", "initial.json", "job_study.yaml",
      "gains.yaml",  "initial.csv",  "tuned.csv",  "starts.csv",   "scenarios.csv"};
  return kNames;
}

std::string ResultFolder::in_folder(const std::string& name) const {
  return (std::filesystem::path(path_) / name).string();
}

std::vector<Failure> ResultFolder::write_design(const std::string& json,
                                                const OptimizationResult& result) const {
  std::vector<Failure> failures;
  const auto write = [&](const char* name, const Text& text) {
    write_file(in_folder(name), text, &failures);
  };
  const std::vector<double> initial = problem_.parameters(result.initial.rho),
                            tuned = problem_.parameters(result.best.rho);
  const auto urdf_at = [this](const std::vector<double>& parameters) {
    return write_tuned_urdf(problem_.urdf(), problem_.overlays(), parameters, std::nullopt,
                            robot_of(problem_).laws);
  };
  write("result.json", [&] { return json; });
  write("tuned.urdf", [&] { return urdf_at(tuned); });
  write("initial.urdf", [&] { return urdf_at(initial); });
  write("initial.json", [&] {
    return to_text({{"parameters", parameters_json(problem_, initial)}});
  });
  write("job_study.yaml", [this] { return problem_.study_text().text; });
  for (const LoadedFile& file : contents_of(problem_).files) {
    try {
      write_named_file(file, path_);
    } catch (const std::exception& error) {
      failures.push_back({"output_failed", error.what()});
    }
  }
  if (!study_of(problem_).hardware.empty())
    write("gains.yaml", [&] { return gains_yaml(problem_, tuned); });
  if (!result.multistart.starts.empty())
    write("starts.csv", [&] {
      return csv_text(start_columns(problem_), start_rows(result), in_folder("starts.csv"));
    });
  if (!result.ensemble.scenarios.empty())
    write("scenarios.csv", [&] {
      return csv_text(scenario_columns(result), scenario_rows(result), in_folder("scenarios.csv"));
    });
  return failures;
}

std::vector<Failure> ResultFolder::write_runs(const OptimizationResult& result,
                                              const std::atomic<bool>* cancel) const {
  std::vector<Failure> failures;
  Json details;
  details["model"] = robot_of(problem_).name;
  details["files"] = {{"model", problem_.urdf().name},
                      {"study", problem_.study_text().name},
                      {"overlays", Json::array()}};
  for (const SourceText& overlay : problem_.overlays())
    if (overlay.name == kFloatingBase)
      details["files"]["base"] = "floating";
    else
      details["files"]["overlays"].push_back(overlay.name);
  details["duration"] = study_of(problem_).duration;
  details["parameters"] = parameter_table(problem_, result);
  const auto record = [&](const char* side, const Eigen::VectorXd& rho) {
    const std::string name = std::string(side) + ".csv";
    try {
      DesignRecord run = record_design(problem_, problem_.parameters(rho), cancel);
      if (!run.status.ok())
        failures.push_back(
            {name_of(run.status.code), in_folder(name) + " ends early: " + describe(run.status)});
      details[side] = std::move(run.summary);
      write_whole_file(in_folder(name), run.csv);
    } catch (const std::exception& error) {
      failures.push_back({"output_failed", error.what()});
    }
  };
  // The tuned design first, since it matters more if time runs out.
  record("tuned", result.best.rho);
  record("initial", result.initial.rho);
  details["gradient_check"] = gradient_check_json(problem_, result, cancel);
  write_file(
      in_folder("details.json"), [&] { return to_text(details); }, &failures);
  return failures;
}

std::string csv_text(const std::vector<std::string>& columns,
                     const std::vector<std::vector<std::string>>& rows, const std::string& where) {
  std::ostringstream text;
  CsvWriter csv(text, columns, where);
  for (const std::vector<std::string>& row : rows) csv.write(row);
  return text.str();
}

std::vector<std::string> convergence_columns(const std::vector<std::string>& tuned_names) {
  std::vector<std::string> columns = {"evaluation",     "iteration",     "status", "objective",
                                      "best_objective", "gradient_norm", "events"};
  columns.insert(columns.end(), tuned_names.begin(), tuned_names.end());
  return columns;
}

std::vector<std::string> convergence_row(const Trial& trial) {
  const auto known = [&trial](double value) {
    return trial.status.ok() ? to_decimal(value) : std::string();
  };
  std::vector<std::string> cells = {
      std::to_string(trial.evaluation), std::to_string(trial.iteration),
      name_of(trial.status.code),       known(trial.objective),
      to_decimal(trial.best_objective), known(trial.gradient_norm),
      std::to_string(trial.events)};
  for (const double value : trial.rho) cells.push_back(to_decimal(value));
  return cells;
}

}  // namespace codesign
