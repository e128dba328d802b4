// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_CLI_JOB_FOLDER_H_
#define MECHANISM_CODESIGN_CLI_JOB_FOLDER_H_

#include <atomic>
#include <fstream>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "cli/csv_writer.h"
#include "cli/json_output.h"
#include "cli/report.h"
#include "jobs/best_record.h"
#include "jobs/lock_file.h"
#include "mechanism_codesign/optimization.h"
#include "problem/load_problem.h"

namespace codesign::cli {

/// The files of one optimization: convergence.csv, best.urdf and best.json as it goes, then result.json, tuned.urdf, initial.csv and
/// tuned.csv, each of them whole. The folder belongs to one optimization at a time, and holds nothing of an earlier one but its best point
/// if it was killed.
class JobFolder {
 public:
  /// Makes the folder and opens convergence.csv. @throws InputError if that cannot be, or if another program is writing there.
  JobFolder(const std::string& path, const Problem& problem);

  /// What was found in the folder and is worth a sentence.
  const std::vector<std::string>& notes() const { return notes_; }

  /// A file that cannot be written does not end the optimization: finish() tells.
  void add(const Trial& trial);

  /// Writes the other files, each of them even if another one fails.
  /// Returns what became of each that is missing or, since its run failed, ends early; none: all is well.
  /// @param cancel set while a run is recorded: it ends early. An optimization that was cancelled before keeps whole runs.
  std::vector<Failure> finish(const Json& result, const Eigen::VectorXd& rho, const std::atomic<bool>& cancel);

 private:
  std::string in_folder(const std::string& name) const;
  void make_room();
  void write_run(const std::string& name, const std::vector<double>& parameters, const std::atomic<bool>* cancel);
  void try_to(const std::function<void()>& write);

  std::string path_;
  const Problem& problem_;
  std::optional<LockFile> lock_;
  std::vector<std::string> notes_;
  std::vector<Failure> failures_;
  std::ofstream convergence_file_;
  std::optional<CsvWriter> convergence_;  // empty once it cannot be written
  BestRecord best_;
};

}  // namespace codesign::cli

#endif  // MECHANISM_CODESIGN_CLI_JOB_FOLDER_H_
