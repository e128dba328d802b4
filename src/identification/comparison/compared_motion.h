// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "identification/fit/identification_result.h"
#include "mechanism_codesign/frame.h"
#include "mechanism_codesign/problem.h"
#include "recordings/joint_recording.h"

namespace codesign {

/// A recording and the motion of the identified model at the same instants.
struct ComparedRecording {
  std::string element;  ///< `identify.data[0]`
  /// Frame::time is the time of the recording's clock [s]. Measured joints have the positions,
  /// velocities and accelerations of measured_motion(); positions that were integrated from a
  /// fitted start begin at the identified start. Their effort on the child is computed from the
  /// recorded number with the identified sensor, (28c) solved for tau [N m or N]; NaN: not
  /// recorded. The identified dimensions determine the positions of links and of joints that were
  /// not measured. A measured frame has no friction.
  std::vector<Frame> measured;
  std::vector<Frame> model;  ///< the frames of the model at the same instants
  Status status;             ///< not ok: the frames end at the failure
};

/// A joint whose efforts are compared, with its place for drawing them.
struct ComparedJoint {
  /// indices in FrameNames: the joint, and its child link, whose origin is at the joint
  std::size_t joint = 0, link = 0;
  /// joint axis in the frame of the link, of unit length
  Eigen::Vector3d axis = Eigen::Vector3d::UnitX();
  bool is_torque = true;  ///< false: a force
};

/// The measured motion beside the motion of the model, for showing both.
struct ComparedMotion {
  FrameNames names;                       ///< of all frames
  std::vector<std::size_t> link_parents;  ///< as link_parents() finds them
  std::vector<ComparedJoint> joints;      ///< joints whose efforts were recorded
  /// data, then holdout, in the order of FittedSeries::lengths
  std::vector<ComparedRecording> recordings;
};

/// The motion of all recordings at the identified design, at about `rate` instants per second [Hz],
/// fewer if all frames would need more than 256 MB.
///
/// For residuals in effort, measured frames and frames of the model have the same motion, and the
/// frames of the model have the efforts, reactions and frictions that this motion needs. For
/// residuals in motion, the model has its simulated motion: the columns `JOINT/position`,
/// `JOINT/velocity` and `JOINT/effort` of the series. Its frictions are computed at the simulated
/// positions and velocities and the measured accelerations.
///
/// Does not throw: if a motion cannot be shown, for example with friction laws with states, the
/// status of the recording says so.
/// @param recordings as given to identify(). @param result of identify(), with numbers. @param stop
/// if given, called at each instant: true ends the comparison, with kCancelled in the status of the
/// recording; later recordings have no frames.
ComparedMotion compare_motion(const Problem& problem, const StudyRecordings& recordings,
                              const IdentificationResult& result, double rate,
                              const std::function<bool()>& stop = {});

}  // namespace codesign
