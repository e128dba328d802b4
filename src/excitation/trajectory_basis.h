// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <functional>
#include <string>
#include <vector>

#include "description/excitation.h"

namespace codesign {

/// The shapes f_k(t) of trajectories q(t) = q_rest + sum c_k f_k(t), doc/theory.md (45). Shapes are
/// periodic; at the begin of the period value, velocity and acceleration of each shape are zero, so
/// that every sum of shapes begins and ends at rest.
class TrajectoryBasis {
 public:
  /// @param description as the study's reader admits it
  explicit TrajectoryBasis(const ExcitationDescription& description);

  Eigen::Index size() const { return size_; }
  double period() const { return period_; }
  /// Shortest time in which a shape goes up and down: the period of the highest harmonic, or four
  /// intervals between knots [s].
  double shortest_wave() const;

  /// Values, rates [1/s] and accelerations [1/s^2] of all shapes.
  struct Shapes {
    Eigen::VectorXd value, rate, acceleration;
  };
  Shapes at(double time) const;

  /// Coefficients of a plain motion, which swings there and back. @param k selects one of several
  /// different plain motions
  Eigen::VectorXd plain(int k) const;

 private:
  void add_fourier(double time, Shapes* shapes) const;
  void add_spline(double time, Shapes* shapes) const;

  const TrajectoryKind kind_;
  const double period_;
  const int waves_;  ///< harmonics, or knots in a period
  Eigen::Index size_;
};

/// The motion of several joints at given times, with the expected efforts; in the joints' units,
/// joints x times.
struct TrajectoryPoints {
  std::vector<std::string> joints;
  std::vector<double> times;  ///< ascending from 0 [s]
  Eigen::MatrixXd position, velocity, acceleration, effort;
};

/// Callback that writes points as one trajectory_msgs/JointTrajectory into a bag. The caller
/// provides it, since this library does not depend on ROS. @throws OutputError if the bag cannot be
/// written. An existing file is replaced.
using TrajectoryBagWriter =
    std::function<void(const std::string& path, const TrajectoryPoints& points)>;

}  // namespace codesign
