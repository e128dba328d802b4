// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <atomic>
#include <fstream>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "cli/report.h"
#include "jobs/csv_writer.h"
#include "jobs/files.h"
#include "jobs/journal.h"
#include "jobs/result_folder.h"
#include "mechanism_codesign/optimization.h"
#include "problem/load_problem.h"

namespace codesign::cli {

/// The output folder of `codesign optimize`. convergence.csv, best.urdf and best.json are written
/// while the optimization runs; finish() writes the files of ResultFolder, each as a whole. A lock
/// admits one optimization at a time. Results of an earlier optimization are removed; its journal
/// is kept as previous_journal.jsonl, and the best point of a killed optimization as
/// killed_best.urdf and killed_best.json.
class JobFolder {
 public:
  /// Creates and locks the folder and opens convergence.csv and journal.jsonl. @param resume
  /// continues with the folder's journal.
  /// @throws InputError if that fails, or if another optimization uses the folder; OutputError if
  /// the journal cannot be written.
  JobFolder(const std::string& path, const Problem& problem, bool resume = false);

  /// Sentences for the user about files of an earlier optimization that were kept.
  const std::vector<std::string>& notes() const { return notes_; }

  /// The memory of evaluations.
  std::shared_ptr<EvaluationMemory> journal() const { return journal_; }
  /// About damaged lines of a journal that is resumed.
  Warnings warnings() const { return journal_->warnings(); }

  /// Records a trial point. A file that cannot be written does not end the optimization; finish()
  /// reports it.
  void add(const Trial& trial);

  /// Writes the remaining files; a failure of one does not affect the others. @param object for
  /// result.json. @param result has the best point, and the searches and scenarios for starts.csv
  /// and scenarios.csv.
  /// @returns one failure for each file that is missing, or incomplete because its run failed;
  /// empty on success.
  /// @param cancel if it is set during this call, the recorded runs end early. If it was set before
  /// (a cancelled optimization), it is ignored and the runs are recorded in full.
  std::vector<Failure> finish(const Json& object, const OptimizationResult& result,
                              const std::atomic<bool>& cancel);

 private:
  std::string in_folder(const std::string& name) const;
  void open_journal(bool resume);
  void make_room(bool resume);
  void add_failures(const std::vector<Failure>& failures);
  void try_to(const std::function<void()>& write);

  std::string path_;
  const Problem& problem_;
  std::optional<LockFile> lock_;
  std::vector<std::string> notes_;
  std::vector<Failure> failures_;
  std::ofstream convergence_file_;
  std::optional<CsvWriter> convergence_;  // empty after a write failed
  BestRecord best_;
  std::shared_ptr<Journal> journal_;
};

}  // namespace codesign::cli
