// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <vector>

#include "identification/driven_motion.h"
#include "identification/motion_projection.h"
#include "observation/observer.h"

namespace codesign {

/// Frames of a mechanism whose measured joints follow the measured motion, at one design: poses, friction, and the efforts of the drives;
/// doc/theory.md (28). Not thread-safe.
class DrivenReplay {
 public:
  /// @param system must outlive this. @param positions of the measured joints at some instants, as in make_driven_system().
  /// @throws InputError as make_driven_system().
  DrivenReplay(const CompiledSystem& system, std::vector<MeasuredJoint> joints, const Eigen::MatrixXd& positions,
               const std::vector<double>& parameters);

  const FrameNames& names() const { return observer_.names(); }

  /// Assembles the mechanism near measured positions [rad or m], one per measured joint. Call it before the first instant of each
  /// recording.
  Status begin(const Eigen::VectorXd& positions);

  /// @param measured positions, velocities and accelerations of the measured joints, near the motion of the previous call.
  /// @param frame its time is not set. It has the efforts on the drives; other efforts are zero.
  Status show(const Eigen::VectorXd (&measured)[3], Frame* frame);

 private:
  const CompiledSystem& system_;
  const std::vector<MeasuredJoint> joints_;
  const std::vector<double> parameters_;
  const DrivenSystem driven_;
  DrivenMotion motion_;
  MotionProjection projection_;
  Observer observer_;
  std::vector<std::size_t> drives_;  ///< index in FrameNames::joints of each drive
  VectorX<double> theta_;            ///< positions at the study's start, for joints that move no mass
  State<double> state_;
};

}  // namespace codesign
