// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "description/signal.h"
#include "equations/compiled_system.h"
#include "identification/effort/driven_system.h"
#include "identification/fit/fit_variables.h"
#include "math/arrays.h"
#include "recordings/joint_recording.h"

namespace codesign {

/// A recorded quantity of a joint, or a recorded signal, that is compared with the simulated
/// motion.
struct MotionOutput {
  std::string joint;
  MeasuredQuantity quantity = MeasuredQuantity::kPosition;
  std::optional<SignalDescription> signal = std::nullopt;  ///< in place of joint and quantity

  std::string name() const {
    return signal ? signal->text : joint + "/" + kMeasuredQuantityNames[to_index(quantity)];
  }
  bool is_effort() const { return !signal && quantity == MeasuredQuantity::kEffort; }
  /// As it was recorded, one number per time.
  const std::vector<double>& recorded(const JointRecording& in) const;
};

/// A mechanism for simulating one recording in segments, doc/theory.md (40): recorded efforts drive
/// the joints that neither a controller nor a given motion of the study drives, and each segment
/// has its own start.
///
/// Its study extends the given study: after the parameters of the given study it has scale, delay
/// and offset of each input, then the numbers of a start. Its tuned parameters are the tuned
/// parameters of the given study, the fitted numbers of inputs, then the start. Its watched signals
/// are the outputs.
struct SegmentSystem {
  std::shared_ptr<const CompiledSystem> system;
  std::vector<MotionOutput> outputs;
  std::vector<std::string> inputs;  ///< joints that a recorded effort drives
  std::vector<int> columns;         ///< index in x of each tuned parameter before the start
  /// size of a start: positions and velocities of the independent joints, integrals of controllers
  int starts = 0;
  double epoch = 0.0;  ///< the time of the recording [s] at which the system's time is zero

  /// All parameters of the system. @param x as FitVariables orders them. @param start the start of
  /// a segment, `starts` numbers
  std::vector<double> parameters(const FitVariables& variables, const Eigen::VectorXd& x,
                                 const Eigen::VectorXd& start) const;
};

/// The outputs to compare with recordings that all have `joints`: positions, velocities that all
/// recordings have, and recorded efforts of joints that a controller or a given motion of the study
/// drives; then the signals of the recordings.
std::vector<MotionOutput> motion_outputs(const CompiledSystem& of,
                                         const std::vector<MeasuredJoint>& joints,
                                         const std::vector<JointRecording>& recordings);

/// @param of the mechanism as make_system() compiled it. @param independent joints whose positions
/// determine the motion, independent_joints().
/// @throws InputError for a study that integrates by IDAS.
SegmentSystem make_segment_system(const CompiledSystem& of, const FitVariables& variables,
                                  const std::vector<MeasuredJoint>& joints,
                                  const std::vector<std::string>& independent,
                                  const std::vector<MotionOutput>& outputs,
                                  const JointRecording& recording);

}  // namespace codesign
