// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "cli/job_folder.h"

#include <unistd.h>

#include <cstdio>
#include <filesystem>
#include <sstream>

#include "cli/inputs.h"
#include "cli/output_file.h"
#include "jobs/ensemble_records.h"
#include "jobs/run_recorder.h"
#include "jobs/whole_file.h"
#include "reading/urdf/urdf_reader.h"
#include "text/decimal.h"

namespace codesign::cli {
namespace {

constexpr int kSamples = 101;
constexpr const char* kJournal = "journal.jsonl";
constexpr const char* kPreviousJournal = "previous_journal.jsonl";

}  // namespace

JobFolder::JobFolder(const std::string& path, const Problem& problem, bool resume)
    : path_(path), problem_(problem), best_(in_folder(""), problem) {
  if (resume)
    require_journal(in_folder(kJournal));
  else
    make_folder(path, "--output");
  lock_ = LockFile::take(in_folder(".codesign_optimize.lock"));
  if (!lock_)
    throw InputError({{path, 0}, "--output", "another optimization is writing into this folder", path, "a folder of its own for each"});
  open_journal(resume);
  make_room(resume);
  open_output(in_folder("convergence.csv"), "--output", &convergence_file_);
  std::vector<std::string> names = {"evaluation", "iteration", "status", "objective", "best_objective", "gradient_norm"};
  for (const std::string& name : problem.tuned_names()) names.push_back(name);
  try_to([&] { convergence_.emplace(convergence_file_, names, in_folder("convergence.csv")); });
}

std::string JobFolder::in_folder(const std::string& name) const { return (std::filesystem::path(path_) / name).string(); }

void JobFolder::open_journal(bool resume) {
  const std::string path = in_folder(kJournal), previous = in_folder(kPreviousJournal);
  if (!resume && std::rename(path.c_str(), previous.c_str()) == 0)
    notes_.push_back("the journal of an earlier optimization in this folder is now " + previous + "; --resume would have gone on with it");
  journal_ = std::make_shared<Journal>(path, problem_, problem_.optimizer_options(), resume ? Journal::Mode::kResume : Journal::Mode::kNew);
  notes_.insert(notes_.end(), journal_->notes().begin(), journal_->notes().end());
}

void JobFolder::make_room(bool resume) {
  for (const char* name : {"result.json", "tuned.urdf", "initial.csv", "tuned.csv", "starts.csv", "scenarios.csv"}) {
    unlink(in_folder(name).c_str());
    unlink((in_folder(name) + kPartSuffix).c_str());
  }
  for (const std::string name : {"best.urdf", "best.json"}) {
    unlink((in_folder(name) + kPartSuffix).c_str());
    // The optimization that is resumed reaches its best point again.
    if (resume) continue;
    if (std::rename(in_folder(name).c_str(), in_folder("killed_" + name).c_str()) == 0)
      notes_.push_back("an optimization in this folder was killed; its best point is now in " + in_folder("killed_" + name));
  }
}

void JobFolder::try_to(const std::function<void()>& write) {
  try {
    write();
  } catch (const std::exception& error) {
    failures_.push_back({"output_failed", error.what()});
  }
}

void JobFolder::add(const Trial& trial) {
  best_.note(trial);
  if (!convergence_) return;
  // A failed point has no objective; its cell is left empty, which CSV readers take as missing.
  const auto known = [&trial](double value) { return trial.status.ok() ? to_decimal(value) : std::string(); };
  std::vector<std::string> cells = {std::to_string(trial.evaluation), std::to_string(trial.iteration),  name_of(trial.status.code),
                                    known(trial.objective),           to_decimal(trial.best_objective), known(trial.gradient_norm)};
  for (const double value : trial.rho) cells.push_back(to_decimal(value));
  const std::size_t before = failures_.size();
  try_to([&] { convergence_->write(cells); });
  if (failures_.size() > before) convergence_.reset();
}

void JobFolder::write_run(const std::string& name, const std::vector<double>& parameters, const std::atomic<bool>* cancel) {
  const std::vector<SignalDescription> signals = select_signals({}, problem_);
  std::ostringstream text;
  CsvWriter csv(text, column_names(signals));
  const auto sink = [&csv](const std::vector<double>& row) { csv.write(row); };
  const Status status = record_run(problem_, parameters, signals, kSamples, sink, cancel).status;
  if (!status.ok()) failures_.push_back({name_of(status.code), in_folder(name) + " ends early: " + describe(status)});
  write_whole_file(in_folder(name), text.str());
}

void JobFolder::write_table(const std::string& name, const std::vector<std::string>& columns,
                            const std::vector<std::vector<std::string>>& rows) {
  try_to([&] {
    std::ostringstream text;
    CsvWriter csv(text, columns, in_folder(name));
    for (const std::vector<std::string>& row : rows) csv.write(row);
    write_whole_file(in_folder(name), text.str());
  });
}

std::vector<Failure> JobFolder::finish(const Json& object, const OptimizationResult& result, const std::atomic<bool>& cancel) {
  const std::atomic<bool>* const watched = cancel ? nullptr : &cancel;
  const std::vector<double> tuned = problem_.parameters(result.rho);
  if (!journal_->failure().empty()) failures_.push_back({"output_failed", journal_->failure()});
  const std::size_t before = failures_.size();
  try_to([&] { write_whole_file(in_folder("result.json"), to_text(object)); });
  try_to([&] { write_whole_file(in_folder("tuned.urdf"), write_tuned_urdf(problem_.urdf(), problem_.overlays(), tuned)); });
  if (!result.starts.empty()) write_table("starts.csv", start_columns(problem_), start_rows(result));
  if (!result.scenarios.empty()) write_table("scenarios.csv", scenario_columns(result), scenario_rows(result));
  if (failures_.size() == before) best_.remove();
  try_to([&] { write_run("initial.csv", problem_.parameters(), watched); });
  try_to([&] { write_run("tuned.csv", tuned, watched); });
  return failures_;
}

}  // namespace codesign::cli
