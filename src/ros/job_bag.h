// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_ROS_JOB_BAG_H_
#define MECHANISM_CODESIGN_ROS_JOB_BAG_H_

#include <mechanism_codesign/OptimizationProgress.h>
#include <mechanism_codesign/OptimizeGoal.h>
#include <mechanism_codesign/OptimizeResult.h>

#include <string>
#include <vector>

#include "ros/recorded_run.h"

namespace codesign {

/// One side of the bag: a design, its URDF and its run.
struct BagSide {
  std::string urdf;
  RecordedRun run;
};

/// Everything one job leaves behind.
struct JobRecord {
  BagSide initial, tuned;
  std::vector<mechanism_codesign::OptimizationProgress> progress;
  mechanism_codesign::OptimizeGoal request;
  mechanism_codesign::OptimizeResult result;
  std::string study;  ///< the text of the study
};

/// Writes the bag as `path`.active and renames it when it is whole. Topics: doc/ros_api.md.
///
/// Recorded time starts at 1 s, and header stamps agree with it. Frames are `initial/<link>` and `tuned/<link>`, both below `world`.
/// The convergence is spread evenly over the duration of the runs, so that a plot shows it beside them.
/// @throws OutputError if the disk does not take it; no unfinished bag is left then.
void write_bag(const std::string& path, const JobRecord& record);

}  // namespace codesign

#endif  // MECHANISM_CODESIGN_ROS_JOB_BAG_H_
