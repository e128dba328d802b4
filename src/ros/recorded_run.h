// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_ROS_RECORDED_RUN_H_
#define MECHANISM_CODESIGN_ROS_RECORDED_RUN_H_

#include <functional>
#include <string>
#include <vector>

#include "problem/load_problem.h"
#include "ros/friction_markers.h"

namespace codesign {

/// A whole study at one design, sampled at a fixed rate.
struct RecordedRun {
  FrameNames names;
  std::vector<Frame> frames;
  Status status;  ///< not ok: the frames end where the run did
};

/// Makes sure that the runs of a job fit into memory and into ROS's time. @param rate samples per second. @throws InputError naming
/// `element` if they do not.
void check_recording(const Problem& problem, double rate, const std::string& element);

/// @param rate samples per second, that check_recording() has let pass.
/// @param stop if given, asked at each sample; true ends the run there.
RecordedRun record_run(const Problem& problem, const std::vector<double>& parameters, double rate, const std::function<bool()>& stop = {});

/// How the initial and the tuned run are shown together.
struct SceneLayout {
  double separation = 0.0;    ///< of the tuned mechanism from the initial one, along -y [m]
  double label_height = 0.0;  ///< where their names stand, above the root link [m]
  double label_size = 0.0;    ///< [m]
  MarkerStyle style;
};

/// Chosen so that the two mechanisms do not overlap, and a typical friction arrow is a third as long as the mechanism, the largest at most
/// as long.
SceneLayout lay_out(const RecordedRun& initial, const RecordedRun& tuned);

}  // namespace codesign

#endif  // MECHANISM_CODESIGN_ROS_RECORDED_RUN_H_
