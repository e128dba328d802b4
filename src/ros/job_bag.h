// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mechanism_codesign/OptimizationProgress.h>
#include <mechanism_codesign/OptimizeGoal.h>
#include <mechanism_codesign/OptimizeResult.h>

#include <optional>
#include <string>
#include <vector>

#include "ros/recorded_run.h"

namespace codesign {

/// The initial or the tuned design in the bag: its URDF and its run.
struct BagSide {
  std::string urdf;
  RecordedRun run;
};

/// Both designs in the same run.
struct BagRuns {
  BagSide initial, tuned;
};

/// The contents of the bag of one job.
struct JobRecord {
  BagRuns nominal;
  std::optional<BagRuns>
      worst;  ///< for a study with runs or uncertain parameters: the scenario with the largest objective at the tuned design
  std::vector<mechanism_codesign::OptimizationProgress> progress;
  mechanism_codesign::OptimizeGoal request;
  mechanism_codesign::OptimizeResult result;
  std::string study;                       ///< the text of the study
  std::vector<std::string> study_files{};  ///< the texts of the files that the study names, such as an identification
};

/// Writes the bag as `path`.active and renames it when it is complete. Topics: doc/ros_api.md.
///
/// Recorded time starts at 1 s, and header stamps are the same. TF frames are `initial/<link>` and `tuned/<link>`, both below `world`. The
/// worst run has the same topics, with the same frames, below `worst/`; so that it can be played in place of the nominal run. The trial
/// points are spread evenly over the duration of the runs, so that a plot shows the convergence next to the runs.
/// @throws OutputError if writing fails; no unfinished bag is left.
void write_bag(const std::string& path, const JobRecord& record);

}  // namespace codesign
