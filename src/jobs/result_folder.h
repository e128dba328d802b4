// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <atomic>
#include <functional>
#include <string>
#include <vector>

#include "jobs/files.h"
#include "mechanism_codesign/optimization.h"
#include "problem/load_problem.h"

namespace codesign {

/// Keeps the best point of a running job on disk: `best.urdf`, the tuned model, and `best.json`
/// with objective, gradient and parameters. Both exist from the first evaluation on and are
/// replaced as a whole at each improvement, so that a killed job leaves complete files.
class BestRecord {
 public:
  /// @param prefix the path before `best.urdf` and `best.json`: "folder/" or "folder/stem.". @param
  /// problem must outlive this.
  BestRecord(std::string prefix, const Problem& problem)
      : prefix_(std::move(prefix)), problem_(problem) {}

  /// Writes the point if it is the best so far. Does not throw if writing fails; see failure().
  void note(const Trial& trial);

  /// Why the last best point could not be written; empty if it was written.
  const std::string& failure() const { return failure_; }

  /// Removes both files; called when the final results are written.
  void remove();

 private:
  std::string json(const Trial& trial) const;

  std::string prefix_;
  const Problem& problem_;
  Trial first_;
  int iteration_ = -1;  ///< iteration of the point on disk; -1: no point yet
  std::string failure_;
};

/// The files that a finished optimization leaves for people, robots and `codesign report`;
/// doc/results.md lists them. They are complete: from tuned.urdf (or initial.urdf), job_study.yaml
/// and result.json the program computes the same objective again, to the last bit. Each file is
/// written as a whole, and a file that cannot be written does not affect the others.
class ResultFolder {
 public:
  /// @param path an existing folder. @param problem must outlive this.
  ResultFolder(std::string path, const Problem& problem)
      : path_(std::move(path)), problem_(problem) {}

  /// The names of all files that any write_...() may write.
  static const std::vector<std::string>& file_names();

  /// Writes result.json, tuned.urdf, initial.urdf, initial.json, job_study.yaml with the files that
  /// it names by relative paths, gains.yaml if the study has `hardware:`, starts.csv and
  /// scenarios.csv if the study has starts or scenarios. @param json the text of result.json.
  /// @returns one failure for each file that is missing.
  std::vector<Failure> write_design(const std::string& json,
                                    const OptimizationResult& result) const;

  /// Runs both designs and checks the gradient if that takes seconds; writes initial.csv, tuned.csv
  /// and details.json.
  /// @param cancel ends the runs early. @returns one failure for each file that is missing, or
  /// incomplete because its run failed.
  std::vector<Failure> write_runs(const OptimizationResult& result,
                                  const std::atomic<bool>* cancel) const;

  std::string in_folder(const std::string& name) const;

 private:
  std::string path_;
  const Problem& problem_;
};

/// A CSV table as text. @param where its file, for messages.
std::string csv_text(const std::vector<std::string>& columns,
                     const std::vector<std::vector<std::string>>& rows, const std::string& where);

/// Columns and a row of convergence.csv: evaluation, iteration, status, objective, best_objective,
/// gradient_norm, events, then the tuned parameters. The objective of a failed point is an empty
/// cell, which readers of CSV take as missing.
std::vector<std::string> convergence_columns(const std::vector<std::string>& tuned_names);
std::vector<std::string> convergence_row(const Trial& trial);

}  // namespace codesign
