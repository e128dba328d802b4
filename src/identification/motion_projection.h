// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <vector>

#include "identification/driven_motion.h"

namespace codesign {

/// Computes the motion of the drives that fits the measured motion of all joints best, if more joints were measured than the mechanism has
/// degrees of freedom; doc/theory.md (28a). Least squares over positions, then over velocities, then over accelerations, each weighted by
/// MeasuredJoint::deviation.
class MotionProjection {
 public:
  /// @param driven must outlive this.
  MotionProjection(const DrivenSystem& driven, const std::vector<MeasuredJoint>& measured);

  /// Whether there is no surplus joint and nothing to project.
  bool empty() const { return surplus_.empty(); }

  /// @param measured position, velocity and acceleration of all measured joints at one sample. @param drives the same of the drives alone;
  /// on return projected. @param motion holds the design. @param state near the measured motion; on return the solution.
  Status project(const Eigen::VectorXd (&measured)[3], Eigen::VectorXd (*drives)[3], DrivenMotion* motion, State<double>* state) const;

 private:
  struct Coordinate {
    int measured, pair, element;
  };
  Eigen::MatrixXd slopes(DrivenMotion* motion, const State<double>& state) const;
  Eigen::VectorXd correction(const Eigen::MatrixXd& K, const Eigen::VectorXd& drive_misses, const Eigen::VectorXd& surplus_misses) const;
  Eigen::VectorXd part_of(const Eigen::VectorXd& measured) const;
  Eigen::VectorXd values(int order, DrivenMotion* motion, const State<double>& state) const;

  const DrivenSystem& driven_;
  std::vector<Coordinate> surplus_;
  Eigen::VectorXd drive_weights_, surplus_weights_;  ///< 1 / deviation^2
};

}  // namespace codesign
