// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mechanism_codesign/IdentificationProgress.h>
#include <mechanism_codesign/IdentifyGoal.h>
#include <mechanism_codesign/IdentifyResult.h>
#include <mechanism_codesign/OptimizationProgress.h>
#include <mechanism_codesign/OptimizeGoal.h>
#include <mechanism_codesign/OptimizeResult.h>

#include <optional>
#include <string>
#include <vector>

#include "jobs/identification_records.h"
#include "mechanism_codesign/optimization.h"
#include "optimization/progress_meter.h"
#include "ros/scene/recorded_run.h"

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

/// A trial point, and the progress of the job at it.
struct LoggedTrial {
  Trial trial;
  Progress progress;
};

/// The contents of the bag of one job.
struct JobRecord {
  BagRuns nominal;
  /// For a study with runs or uncertain parameters: the scenario with the largest objective at the
  /// tuned design.
  std::optional<BagRuns> worst;
  std::vector<LoggedTrial> trials;
  mechanism_codesign::OptimizeGoal request;
  mechanism_codesign::OptimizeResult result;
  std::string study;  ///< the text of the study
  /// the texts of the files that the study names, such as an identification
  std::vector<std::string> study_files{};
};

/// Writes the bag as `path`.active and renames it when it is complete. Topics: doc/ros_api.md.
///
/// Recorded time starts at 1 s, and header stamps are the same. TF frames are `initial/<link>` and
/// `tuned/<link>`, both below `world`. The worst run has the same topics, with the same frames,
/// below `worst/`; so that it can be played in place of the nominal run. The trial points are
/// spread evenly over the duration of the runs, so that a plot shows the convergence next to the
/// runs.
/// @throws OutputError if writing fails; no unfinished bag is left.
void write_bag(const std::string& path, const JobRecord& record);

/// An Eigen vector as an array of a ROS message.
std::vector<double> to_array(const Eigen::VectorXd& values);

/// The message of a trial point, without stamp and progress. @param parameters names of the tuned
/// parameters.
mechanism_codesign::OptimizationProgress optimization_progress(
    const Trial& trial, const std::string& job, const std::vector<std::string>& parameters);
void set_progress(const Progress& progress, mechanism_codesign::OptimizationProgress* message);

/// Contents that only the bag of a node's job has.
struct IdentificationAnswer {
  mechanism_codesign::IdentifyGoal request;
  mechanism_codesign::IdentifyResult result;
  std::vector<mechanism_codesign::IdentificationProgress> progress;
};

/// Writes the bag as `path`.active and renames it when it is complete. Topics: doc/ros_api.md.
///
/// Recorded time starts at 1 s, and header stamps are the same; the recordings follow one another
/// with pauses of half a second. TF frames are `measured/<link>` and `identified/<link>`, both at
/// the origin of `world`, so that the measured robot appears as a ghost of the identified robot.
/// @param answer null for the command line. @throws OutputError if writing fails; no unfinished bag
/// is left.
void write_identification_bag(const std::string& path, const IdentificationShow& show,
                              const IdentificationAnswer* answer);

}  // namespace codesign
