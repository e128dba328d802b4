// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "mechanism_codesign/optimization.h"
#include "problem/load_problem.h"

namespace codesign {

/// Keeps the best point of a running job on disk: `best.urdf`, the tuned model, and `best.json` with objective, gradient and parameters.
/// Both exist from the first evaluation on and are replaced as a whole at each improvement, so that a killed job leaves complete files.
class BestRecord {
 public:
  /// @param prefix the path before `best.urdf` and `best.json`: "folder/" or "folder/stem.". @param problem must outlive this.
  BestRecord(std::string prefix, const Problem& problem) : prefix_(std::move(prefix)), problem_(problem) {}

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

}  // namespace codesign
