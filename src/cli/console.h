// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <atomic>
#include <ostream>

#include "excitation/trajectory_basis.h"
#include "jobs/identification_records.h"
#include "recordings/joint_recording.h"

namespace codesign {
class Dispatcher;
}

namespace codesign::cli {

/// The output streams and the cancel flag of a command.
struct Console {
  std::ostream& out;  ///< results only
  std::ostream& err;  ///< progress and messages
  /// once set, the command ends soon and keeps its results so far
  const std::atomic<bool>& cancel;
  /// called after the input is loaded, before the computation; may be null
  void (*loaded)() = nullptr;
  Dispatcher* ranks = nullptr;  ///< the processes of the job, as in require_engine()
  BagReader bags = {};          ///< reads the bags that a study names; empty: they are refused
  /// writes the bag of an identification; empty: none is written
  IdentificationBagWriter identification_bag = {};
  TrajectoryBagWriter trajectories = {};  ///< writes bags of trajectories; empty: none are written
};

/// The program's exit codes.
enum ExitCode : int { kDone = 0, kFailed = 1, kBadInput = 2 };

}  // namespace codesign::cli
