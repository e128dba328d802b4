// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_IDENTIFICATION_COMPARED_MOTION_H_
#define MECHANISM_CODESIGN_IDENTIFICATION_COMPARED_MOTION_H_

#include <functional>
#include <string>
#include <vector>

#include "identification/identification_result.h"
#include "mechanism_codesign/frame.h"
#include "mechanism_codesign/problem.h"
#include "recordings/load_recordings.h"

namespace codesign {

/// A recording as it was measured and as the identified model has it, at the same instants.
struct ComparedRecording {
  std::string element;  ///< `identify.data[0]`
  /// Frame::time by the clock of the recording [s]. Measured joints have the positions, velocities and accelerations of measured_motion()
  /// (positions that were integrated from a fitted start begin at the identified one),
  /// and as effort what the identified sensor says of the effort on the child, (28c) solved for tau [N m or N]; NaN: not recorded. Joints
  /// that were not measured, and links, stand where the identified dimensions put them. A measured frame has no friction.
  std::vector<Frame> measured;
  std::vector<Frame> model;  ///< as many
  Status status;             ///< not ok: the instants end there
};

/// A joint whose efforts are compared, for drawing them.
struct ComparedJoint {
  std::size_t joint = 0, link = 0;                  ///< indices in FrameNames: the joint, and its child, at whose origin it is
  Eigen::Vector3d axis = Eigen::Vector3d::UnitX();  ///< in the frame of the link, of unit length
  bool is_torque = true;                            ///< else a force
};

/// What was measured beside what the model says of it, for showing both.
struct ComparedMotion {
  FrameNames names;                           ///< of all frames
  std::vector<ComparedJoint> joints;          ///< those whose efforts were recorded
  std::vector<ComparedRecording> recordings;  ///< data, then holdout: those of FittedSeries::lengths
};

/// The motion of all recordings at the identified design, at about `rate` instants per second [Hz], fewer if all frames would need more
/// than 256 MB.
///
/// For residuals in effort both sides move alike, and the frames of the model have the efforts, reactions and frictions that this motion
/// needs. For residuals in motion the model moves as it was simulated: by the columns `JOINT/position`, `JOINT/velocity` and `JOINT/effort`
/// of the series; its frictions are those at the simulated positions and velocities and the measured accelerations.
///
/// Does not throw: what cannot be shown, such as friction laws with states, is told by the status of the recordings.
/// @param recordings, result as identify() was given and has returned them; with numbers. @param stop if given, asked at each instant: true
/// ends with kCancelled in the status of the recording; later ones have no instants.
ComparedMotion compare_motion(const Problem& problem, const StudyRecordings& recordings, const IdentificationResult& result, double rate,
                              const std::function<bool()>& stop = {});

}  // namespace codesign

#endif  // MECHANISM_CODESIGN_IDENTIFICATION_COMPARED_MOTION_H_
