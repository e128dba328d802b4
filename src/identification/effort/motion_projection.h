// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <vector>

#include "assembly/driven_motion.h"
#include "equations/compiled_system.h"
#include "identification/effort/driven_system.h"
#include "observation/observer.h"

namespace codesign {

/// Computes the motion of the drives that fits the measured motion of all joints best, if more
/// joints were measured than the mechanism has degrees of freedom; doc/theory.md (28a). Least
/// squares over positions, then over velocities, then over accelerations, each weighted by
/// MeasuredJoint::deviation.
class MotionProjection {
 public:
  /// @param driven must outlive this.
  MotionProjection(const DrivenSystem& driven, const std::vector<MeasuredJoint>& measured);

  /// Whether there is no surplus joint and nothing to project.
  bool empty() const { return surplus_.empty(); }

  /// @param measured position, velocity and acceleration of all measured joints at one sample.
  /// @param drives the same of the drives alone; on return projected. @param motion holds the
  /// design. @param state near the measured motion; on return the solution.
  Status project(const Eigen::VectorXd (&measured)[3], Eigen::VectorXd (*drives)[3],
                 DrivenMotion* motion, State<double>* state) const;

 private:
  struct Coordinate {
    int measured, pair, element;
  };
  Eigen::MatrixXd slopes(DrivenMotion* motion, const State<double>& state) const;
  Eigen::VectorXd correction(const Eigen::MatrixXd& K, const Eigen::VectorXd& drive_misses,
                             const Eigen::VectorXd& surplus_misses) const;
  Eigen::VectorXd part_of(const Eigen::VectorXd& measured) const;
  Eigen::VectorXd values(int order, DrivenMotion* motion, const State<double>& state) const;

  const DrivenSystem& driven_;
  std::vector<Coordinate> surplus_;
  Eigen::VectorXd drive_weights_, surplus_weights_;  ///< 1 / deviation^2
};

/// Frames of a mechanism whose measured joints follow the measured motion, at one design: poses,
/// friction, and the efforts of the drives; doc/theory.md (28). Not thread-safe.
class DrivenReplay {
 public:
  /// @param system must outlive this. @param positions of the measured joints at some instants, as
  /// in make_driven_system(). @param signals of the frames; there are no controllers.
  /// @throws InputError as make_driven_system(), and for a signal that does not exist.
  DrivenReplay(const CompiledSystem& system, std::vector<MeasuredJoint> joints,
               const Eigen::MatrixXd& positions, const std::vector<double>& parameters,
               const std::vector<SignalDescription>& signals = {});

  const FrameNames& names() const { return observer_.names(); }
  /// Index in FrameNames::joints of each drive.
  const std::vector<std::size_t>& drives() const { return drives_; }

  /// Assembles the mechanism near measured positions [rad or m], one per measured joint. Call it
  /// before the first instant of each recording.
  Status begin(const Eigen::VectorXd& positions);

  /// @param time of the motion [s], for loads that depend on it.
  /// @param measured positions, velocities and accelerations of the measured joints, near the
  /// motion of the previous call.
  /// @param frame It has the efforts of the drives; other efforts are zero.
  Status show(double time, const Eigen::VectorXd (&measured)[3], Frame* frame);

  /// Whether the positions of the drives do not determine the motion at the last instant shown: a
  /// dead centre, or a position where several motions meet.
  bool is_singular();

 private:
  const CompiledSystem& system_;
  const std::vector<MeasuredJoint> joints_;
  const std::vector<double> parameters_;
  const DrivenSystem driven_;
  DrivenMotion motion_;
  MotionProjection projection_;
  Observer observer_;
  std::vector<std::size_t> drives_;
  VectorX<double> theta_;  ///< positions at the study's start, for joints that move no mass
  State<double> state_;
};

}  // namespace codesign
