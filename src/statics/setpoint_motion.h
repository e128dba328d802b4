// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <vector>

#include "control/reference.h"
#include "identification/effort/driven_system.h"

namespace codesign {

struct MotionStudy;

/// The motion that a study asks of its joints: those of its `motion`, and each joint whose position
/// a controller controls has the position, rate and acceleration of the set-point, without an
/// error.
class SetpointMotion {
 public:
  /// @param parameters all named parameters.
  /// @throws InputError if no joint has a motion, or two controllers control one joint.
  SetpointMotion(const MotionStudy& study, const std::vector<double>& parameters);

  const std::vector<MeasuredJoint>& joints() const { return joints_; }
  /// Positions, rates and accelerations at a time [s], in the order of joints().
  void at(double time, Eigen::VectorXd (*given)[3]) const;
  /// Positions at a few instants up to `duration`, one column per instant.
  Eigen::MatrixXd some_positions(double duration) const;

 private:
  std::vector<MeasuredJoint> joints_;
  std::vector<Reference<double>> motions_;
};

}  // namespace codesign
