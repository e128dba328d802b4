// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "cli/job_folder.h"

#include <filesystem>

#include "cli/inputs.h"
#include "cli/output_file.h"
#include "cli/run_recorder.h"
#include "mechanism_codesign/math/decimal.h"

namespace codesign::cli {
namespace {

constexpr int kSamples = 101;

std::string in_folder(const std::string& folder, const std::string& name) { return (std::filesystem::path(folder) / name).string(); }

}  // namespace

JobFolder::JobFolder(const std::string& path, const Problem& problem) : path_(path), problem_(problem) {
  make_folder(path, "--output");
  open_output(in_folder(path, "convergence.csv"), "--output", &convergence_file_);
  std::vector<std::string> names = {"evaluation", "iteration", "status", "objective", "best_objective", "gradient_norm"};
  for (const std::string& name : problem.tuned_names()) names.push_back(name);
  convergence_.emplace(convergence_file_, names);
}

void JobFolder::add(const Trial& trial) {
  // A point that failed has no objective; an empty cell says so to every reader of CSV.
  const auto known = [&trial](double value) { return trial.status.ok() ? to_decimal(value) : std::string(); };
  std::vector<std::string> cells = {std::to_string(trial.evaluation), std::to_string(trial.iteration),  name_of(trial.status.code),
                                    known(trial.objective),           to_decimal(trial.best_objective), known(trial.gradient_norm)};
  for (const double value : trial.rho) cells.push_back(to_decimal(value));
  convergence_->write(cells);
}

Status JobFolder::write_run(const std::string& name, const std::vector<double>& parameters) const {
  const std::vector<SignalDescription> signals = select_signals({}, problem_);
  std::ofstream file;
  open_output(in_folder(path_, name), "--output", &file);
  CsvWriter csv(file, column_names(signals));
  return record_run(problem_, parameters, signals, kSamples, [&csv](const std::vector<double>& row) { csv.write(row); }).status;
}

Status JobFolder::finish(const Json& result, const Eigen::VectorXd& rho) {
  const std::vector<double> tuned = problem_.parameters(rho);
  write_file(in_folder(path_, "result.json"), result.dump(2) + "\n");
  write_file(in_folder(path_, "tuned.urdf"), write_tuned_urdf(problem_.urdf, problem_.overlays, tuned));
  const Status initial_run = write_run("initial.csv", problem_.parameters());
  const Status tuned_run = write_run("tuned.csv", tuned);
  return initial_run.ok() ? tuned_run : initial_run;
}

}  // namespace codesign::cli
