// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_JOBS_BEST_RECORD_H_
#define MECHANISM_CODESIGN_JOBS_BEST_RECORD_H_

#include <string>

#include "mechanism_codesign/optimization.h"
#include "problem/load_problem.h"

namespace codesign {

/// The best point so far of a job that is running, on disk from its first evaluation on: `best.urdf`, the tuned model, and `best.json`, its
/// objective, gradient and parameters. Each is replaced as a whole at each improvement, so that a killed job leaves both.
class BestRecord {
 public:
  /// @param prefix what stands before `best.urdf` and `best.json`: "folder/" or "folder/stem.". Outlives nothing: `problem` must live on.
  BestRecord(std::string prefix, const Problem& problem) : prefix_(std::move(prefix)), problem_(problem) {}

  /// Writes the point if it is the best so far. A job does not fail because its record does: see failure().
  void note(const Trial& trial);

  /// Why the last point could not be written; empty if it was.
  const std::string& failure() const { return failure_; }

  /// Removes both files, once the job has left something better.
  void remove();

 private:
  std::string json(const Trial& trial) const;

  std::string prefix_;
  const Problem& problem_;
  Trial first_;
  int iteration_ = -1;  ///< of the point on disk; -1: none yet
  std::string failure_;
};

}  // namespace codesign

#endif  // MECHANISM_CODESIGN_JOBS_BEST_RECORD_H_
