// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_ROS_RECORDED_RUN_H_
#define MECHANISM_CODESIGN_ROS_RECORDED_RUN_H_

#include <functional>
#include <string>
#include <vector>

#include "problem/load_problem.h"
#include "ros/friction_markers.h"

namespace codesign {

/// A run of a study at one design, sampled at a fixed rate.
struct RecordedRun {
  FrameNames names;
  std::vector<Frame> frames;
  Status status;  ///< if not ok, the frames end where the run failed or was stopped
};

/// Checks that the runs of a job, of both designs, nominal and worst, fit into memory (256 MB) and into the range of ROS time. @param rate
/// samples per second.
/// @param element where the rate was given. @throws InputError for a duration or a rate that is too large.
void check_recording(const Problem& problem, double rate, const std::string& element);

/// Runs a study at `parameters`, all named ones, and samples it at equally spaced instants from 0 to its duration.
/// @param system of the run, such as that of a scenario. @param rate samples per second, accepted by check_recording(). @param stop if
/// given, called repeatedly; true ends the run with kCancelled.
RecordedRun record_run(const std::shared_ptr<const CompiledSystem>& system, const std::vector<double>& parameters, double rate,
                       const std::function<bool()>& stop = {});

/// Placement and scales for showing the initial and the tuned run together in rviz.
struct SceneLayout {
  double separation = 0.0;    ///< distance of the tuned mechanism from the initial one, along -y [m]
  double label_height = 0.0;  ///< height of their labels above the root link [m]
  double label_size = 0.0;    ///< height of the letters [m]
  MarkerStyle style;
};

/// A layout in which the two mechanisms do not overlap, an arrow of the root-mean-square friction is a third as long as the mechanism, and
/// the largest arrow at most as long as the mechanism.
SceneLayout lay_out(const RecordedRun& initial, const RecordedRun& tuned);

}  // namespace codesign

#endif  // MECHANISM_CODESIGN_ROS_RECORDED_RUN_H_
