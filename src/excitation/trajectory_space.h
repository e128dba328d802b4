// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <vector>

#include "excitation/excited_motion.h"
#include "excitation/motion_limits.h"
#include "excitation/trajectory_basis.h"

namespace codesign {

/// All shapes at given times, times x shapes.
struct SampledShapes {
  SampledShapes(const TrajectoryBasis& basis, const std::vector<double>& times);

  Eigen::MatrixXd value, rate, acceleration;
};

/// The trajectories of all excited joints as points x of a search: per joint the position at rest,
/// then the coefficients of the shapes, all of magnitude one. A rest of -1 or 1 is at a limit of
/// the position. With a coefficient of 1 and all others zero, the shape reaches a limit of
/// position, velocity or acceleration.
class TrajectorySpace {
 public:
  /// @param start positions of the joints at the study's start, for joints without limits [rad or
  /// m].
  TrajectorySpace(const ExcitationDescription& description, const MotionLimits& limits,
                  const Eigen::VectorXd& start);

  const TrajectoryBasis& basis() const { return basis_; }
  Eigen::Index joints() const { return rest_middle_.size(); }
  Eigen::Index size() const { return joints() * stride(); }
  /// Bounds of a search.
  Eigen::VectorXd upper() const;
  Eigen::VectorXd lower() const { return -upper(); }
  /// Positions of the joints at rest [rad or m].
  Eigen::VectorXd rest(const Eigen::VectorXd& x) const;
  /// The coefficients of the shapes in the joints' units, shapes x joints.
  Eigen::MatrixXd coefficients(const Eigen::VectorXd& x) const;

  DrivePath path(const Eigen::VectorXd& x, const SampledShapes& at) const;
  /// Derivatives by x of a number whose derivatives by the motion are known.
  /// @param by_motion 3 joints x samples: by positions, velocities and accelerations
  Eigen::VectorXd pull_back(const SampledShapes& at, const Eigen::MatrixXd& by_motion) const;

  /// The plain trajectory: each joint swings there and back around the middle of its range, with
  /// its own rhythm, as far as its limits of position, velocity and acceleration permit.
  Eigen::VectorXd plain() const;
  /// The plain trajectory with the joints at rest at `positions`, clipped to their limits.
  Eigen::VectorXd plain_around(const Eigen::VectorXd& positions) const;
  /// A trajectory with rest and coefficients in proportion to `numbers` in (0, 1), as unit_points()
  /// gives them, within the limits of position, velocity and acceleration.
  Eigen::VectorXd mixed(const Eigen::VectorXd& numbers) const;
  /// x with all excursions from rest multiplied by a factor.
  Eigen::VectorXd shrunk(Eigen::VectorXd x, double factor) const;

 private:
  Eigen::Index stride() const { return 1 + basis_.size(); }
  /// The factor with which the shapes with coefficients c reach a limit of velocity or
  /// acceleration.
  double factor_by_rates(Eigen::Index joint, const Eigen::VectorXd& c) const;
  void fit_joint(Eigen::Index joint, Eigen::VectorXd* x) const;

  const MotionLimits& limits_;
  const TrajectoryBasis basis_;
  const SampledShapes fine_;
  Eigen::VectorXd rest_middle_, rest_half_;
  /// the coefficient in the joint's unit for an entry of one in x, shapes x joints
  Eigen::MatrixXd scale_;
};

/// `count` equally spaced times in [0, period).
std::vector<double> times_in_period(double period, Eigen::Index count);

}  // namespace codesign
