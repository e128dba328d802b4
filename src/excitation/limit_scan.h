// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <vector>

#include "excitation/excited_motion.h"
#include "excitation/motion_limits.h"

namespace codesign {

class TrajectorySpace;

/// The extreme values of a limited signal between the samples.
struct ScannedSignal {
  double lowest = 0.0, highest = 0.0;
};

/// The samples of a limited signal along a path, a row.
Eigen::RowVectorXd samples_of(const LimitedSignal& signal, const DrivePath& path,
                              const PathResponse& response);

/// Searches the extreme values of all limited signals over a whole period: at many times, with more
/// times where a joint changes its direction, since friction changes its sign there within a small
/// part of a sample, and with ever finer times at the largest peaks.
class LimitScan {
 public:
  /// All arguments must outlive this.
  LimitScan(const TrajectorySpace& space, const MotionLimits& limits, ExcitedMotion* motion)
      : space_(space), limits_(limits), motion_(*motion) {}

  struct Extremes {
    Status status;       ///< not ok: the motion cannot be followed
    double worst = 0.0;  ///< largest |z| of all signals; at most 1 within the limits
    std::vector<ScannedSignal> signals;  ///< in the order of MotionLimits::signals
  };
  Extremes scan(const Eigen::VectorXd& x);

  /// Reduces all excursions by the same factor, no more than necessary to stay within all limits.
  /// @return false if the positions at rest violate a limit, or if even a small motion cannot be
  /// followed.
  bool fit(Eigen::VectorXd* x, Extremes* extremes);

 private:
  struct ScanPoint {
    double time;
    Eigen::VectorXd values;  ///< values of the signals
  };
  std::vector<double> first_times(const Eigen::VectorXd& x) const;
  Status evaluate(const Eigen::VectorXd& x, const std::vector<double>& times,
                  std::vector<ScanPoint>* points);
  std::vector<double> finer_times(const std::vector<ScanPoint>& points) const;
  double relative(const ScanPoint& point, std::size_t signal) const;

  const TrajectorySpace& space_;
  const MotionLimits& limits_;
  ExcitedMotion& motion_;
};

}  // namespace codesign
