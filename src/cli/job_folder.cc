// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "cli/job_folder.h"

#include <unistd.h>

#include <cstdio>
#include <filesystem>

#include "cli/inputs.h"
#include "jobs/files.h"
#include "jobs/job_files.h"
#include "jobs/json.h"
#include "jobs/result_folder.h"

namespace codesign::cli {
namespace {

constexpr const char* kJournal = "journal.jsonl";
constexpr const char* kPreviousJournal = "previous_journal.jsonl";
constexpr const char* kConvergence = "convergence.csv";

}  // namespace

JobFolder::JobFolder(const std::string& path, const Problem& problem, bool resume)
    : path_(path), problem_(problem), best_(in_folder(""), problem) {
  if (resume)
    require_journal(in_folder(kJournal));
  else
    make_folder(path, "--output");
  std::vector<std::string> names = ResultFolder::file_names();
  names.push_back(kConvergence);
  require_other_files(path, names, "--output", problem);
  lock_ = LockFile::take(in_folder(".codesign_optimize.lock"));
  if (!lock_)
    throw InputError({{path, 0},
                      "--output",
                      "another optimization is writing into this folder",
                      path,
                      "a folder of its own for each"});
  open_journal(resume);
  make_room(resume);
  const std::string convergence = in_folder(kConvergence);
  // A link of this name is replaced, not the file that it leads to.
  unlink(convergence.c_str());
  open_output(convergence, "--output", &convergence_file_);
  try_to([&] {
    convergence_.emplace(convergence_file_, convergence_columns(problem.tuned_names()),
                         convergence);
  });
}

std::string JobFolder::in_folder(const std::string& name) const {
  return (std::filesystem::path(path_) / name).string();
}

void JobFolder::open_journal(bool resume) {
  const std::string path = in_folder(kJournal), previous = in_folder(kPreviousJournal);
  if (!resume && std::rename(path.c_str(), previous.c_str()) == 0)
    notes_.push_back("the journal of an earlier optimization in this folder is now " + previous +
                     "; --resume would have gone on with it");
  journal_ = std::make_shared<Journal>(path, problem_, problem_.optimizer_options(),
                                       resume ? Journal::Mode::kResume : Journal::Mode::kNew);
  notes_.insert(notes_.end(), journal_->notes().begin(), journal_->notes().end());
}

void JobFolder::make_room(bool resume) {
  for (const std::string& name : ResultFolder::file_names()) {
    unlink(in_folder(name).c_str());
    unlink((in_folder(name) + kPartSuffix).c_str());
  }
  for (const std::string name : {"best.urdf", "best.json"}) {
    unlink((in_folder(name) + kPartSuffix).c_str());
    // The resumed optimization reaches its best point again.
    if (resume) continue;
    if (std::rename(in_folder(name).c_str(), in_folder("killed_" + name).c_str()) == 0)
      notes_.push_back("an optimization in this folder was killed; its best point is now in " +
                       in_folder("killed_" + name));
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
  const std::size_t before = failures_.size();
  try_to([&] { convergence_->write(convergence_row(trial)); });
  if (failures_.size() > before) convergence_.reset();
}

void JobFolder::add_failures(const std::vector<Failure>& failures) {
  failures_.insert(failures_.end(), failures.begin(), failures.end());
}

std::vector<Failure> JobFolder::finish(const Json& object, const OptimizationResult& result,
                                       const std::atomic<bool>& cancel) {
  const std::atomic<bool>* const watched = cancel ? nullptr : &cancel;
  if (!journal_->failure().empty()) failures_.push_back({"output_failed", journal_->failure()});
  const std::size_t before = failures_.size();
  const ResultFolder folder(path_, problem_);
  add_failures(folder.write_design(to_text(object), result));
  if (failures_.size() == before) best_.remove();
  add_failures(folder.write_runs(result, watched));
  return failures_;
}

}  // namespace codesign::cli
