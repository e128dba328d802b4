// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_CLI_JOB_FOLDER_H_
#define MECHANISM_CODESIGN_CLI_JOB_FOLDER_H_

#include <fstream>
#include <optional>
#include <string>

#include "cli/csv_writer.h"
#include "cli/json_output.h"
#include "mechanism_codesign/optimization/optimizer.h"
#include "mechanism_codesign/optimization/problem.h"

namespace codesign::cli {

/// The files of one optimization: convergence.csv as it goes, then result.json, tuned.urdf, initial.csv and tuned.csv.
class JobFolder {
 public:
  /// Makes the folder and opens convergence.csv. @throws InputError if that cannot be.
  JobFolder(const std::string& path, const Problem& problem);

  void add(const Trial& trial);

  /// Writes the other files; the status tells if one of the two runs failed, whose file then ends early.
  /// @throws std::runtime_error if a file cannot be written.
  Status finish(const Json& result, const Eigen::VectorXd& rho);

 private:
  Status write_run(const std::string& name, const std::vector<double>& parameters) const;

  std::string path_;
  const Problem& problem_;
  std::ofstream convergence_file_;
  std::optional<CsvWriter> convergence_;
};

}  // namespace codesign::cli

#endif  // MECHANISM_CODESIGN_CLI_JOB_FOLDER_H_
