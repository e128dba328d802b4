// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_JOBS_JOB_FILES_H_
#define MECHANISM_CODESIGN_JOBS_JOB_FILES_H_

#include <string>
#include <vector>

#include "jobs/lock_file.h"

namespace codesign {

/// Reserves the file names of one job in a folder that is shared by jobs of several processes. The stem is `<robot>_%Y-%m-%d-%H-%M-%S` in
/// local time, followed by `-2`, `-3`, ... if it is taken; the files are `<stem>.bag`, `<stem>.best.json`, ... The lock file `<stem>.job`
/// shows that the job is running.
class JobFiles {
 public:
  /// Creates the folder and reserves a stem. Characters of the robot's name other than letters, digits and `-` become `_`, and a long name
  /// is shortened to the limit of the file system. @throws OutputError if the folder or the lock file cannot be created.
  JobFiles(const std::string& directory, const std::string& robot);

  const std::string& stem() const { return stem_; }
  std::string bag() const { return stem_ + ".bag"; }

 private:
  JobFiles(std::string stem, LockFile lock) : stem_(std::move(stem)), lock_(std::move(lock)) {}
  static JobFiles reserve(const std::string& directory, const std::string& robot);

  std::string stem_;
  LockFile lock_;
};

/// Removes the unfinished files of killed jobs in a folder; files of running jobs and best points stay. @returns one sentence per killed
/// job.
std::vector<std::string> remove_leftovers(const std::string& directory);

}  // namespace codesign

#endif  // MECHANISM_CODESIGN_JOBS_JOB_FILES_H_
