// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_EXCITATION_LIMIT_SCAN_H_
#define MECHANISM_CODESIGN_EXCITATION_LIMIT_SCAN_H_

#include <Eigen/Core>
#include <vector>

#include "excitation/excited_motion.h"
#include "excitation/motion_limits.h"
#include "excitation/trajectory_space.h"

namespace codesign {

/// What a limited signal does between the samples.
struct ScannedSignal {
  double lowest = 0.0, highest = 0.0;
};

/// Looks for the extreme values of all limited signals over a whole period: at many times, more of them where a joint turns back, since
/// friction turns there within a small part of a sample, and ever finer at the largest peaks.
class LimitScan {
 public:
  /// All arguments must outlive this.
  LimitScan(const TrajectorySpace& space, const MotionLimits& limits, ExcitedMotion* motion)
      : space_(space), limits_(limits), motion_(*motion) {}

  struct Extremes {
    Status status;                       ///< not ok: the motion cannot be followed
    double worst = 0.0;                  ///< largest |z| of all signals; at most 1 within the limits
    std::vector<ScannedSignal> signals;  ///< in the order of MotionLimits::signals
  };
  Extremes scan(const Eigen::VectorXd& x);

  /// Makes all excursions smaller by the same factor, as little as keeps all limits. @return false if not even the rest keeps them, or the
  /// motion cannot be followed however small it is.
  bool fit(Eigen::VectorXd* x, Extremes* extremes);

 private:
  struct ScanPoint {
    double time;
    Eigen::VectorXd values;  ///< of the signals
  };
  std::vector<double> first_times(const Eigen::VectorXd& x) const;
  Status evaluate(const Eigen::VectorXd& x, const std::vector<double>& times, std::vector<ScanPoint>* points);
  std::vector<double> finer_times(const std::vector<ScanPoint>& points) const;
  double relative(const ScanPoint& point, std::size_t signal) const;

  const TrajectorySpace& space_;
  const MotionLimits& limits_;
  ExcitedMotion& motion_;
};

}  // namespace codesign

#endif  // MECHANISM_CODESIGN_EXCITATION_LIMIT_SCAN_H_
