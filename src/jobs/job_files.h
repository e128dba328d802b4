// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_JOBS_JOB_FILES_H_
#define MECHANISM_CODESIGN_JOBS_JOB_FILES_H_

#include <string>
#include <vector>

#include "jobs/lock_file.h"

namespace codesign {

/// The names of one job's files in a folder that the jobs of many processes share: `<robot>_%Y-%m-%d-%H-%M-%S` in local time, with `-2`,
/// `-3`, ... behind it if that is taken, and then `.bag`, `.best.json`, ... A locked `.job` beside them tells that the job is alive.
class JobFiles {
 public:
  /// Makes the folder and takes a name. Characters of the robot's name that could lead out of the folder are replaced, and a long name is
  /// shortened to what the file system takes. @throws OutputError if that cannot be.
  JobFiles(const std::string& directory, const std::string& robot);

  const std::string& stem() const { return stem_; }
  std::string bag() const { return stem_ + ".bag"; }

 private:
  JobFiles(std::string stem, LockFile lock) : stem_(std::move(stem)), lock_(std::move(lock)) {}
  static JobFiles reserve(const std::string& directory, const std::string& robot);

  std::string stem_;
  LockFile lock_;
};

/// Removes what killed jobs left unfinished in a folder, files of living ones excepted, and says so, a sentence each. Best points stay.
std::vector<std::string> remove_leftovers(const std::string& directory);

}  // namespace codesign

#endif  // MECHANISM_CODESIGN_JOBS_JOB_FILES_H_
