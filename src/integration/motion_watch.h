// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_INTEGRATION_MOTION_WATCH_H_
#define MECHANISM_CODESIGN_INTEGRATION_MOTION_WATCH_H_

#include <cstdint>

#include "equations/equations.h"
#include "mechanism_codesign/status.h"

namespace codesign {

/// Ends a motion that runs away, as under a controller of the wrong sign: it could be integrated, but in ever more steps and to no use.
///
/// With `solver.maximum_speed` that is any body beyond it. Without, there must be a controller, a body must be ten times as fast as the
/// mechanism has reason to be (its start, a fall through its own size, the velocities that setpoints and references ask for, or that theirs
/// of positions imply), and at the pace of the last 500 steps the study must take more than a tenth of `maximum_steps` (at least 5000).
/// Speeds are |r'| [m/s] and |omega| [rad/s].
class MotionWatch {
 public:
  explicit MotionWatch(const CompiledSystem& system) : system_(system) {}

  /// @param equations at the design; `initial` its start.
  void start(const Equations<double>& equations, const State<double>& initial);
  /// After each step. @param work steps so far, the rejected ones too.
  Status check(const State<double>& state, std::int64_t work);

 private:
  struct Speeds {
    double linear = 0.0, angular = 0.0;  ///< of the fastest bodies
    int linear_body = 0, angular_body = 0;
  };
  Speeds speeds(const State<double>& state) const;
  double target(const Equations<double>& equations) const;
  double expected_work(double time, std::int64_t work) const;
  Status exceeded(const State<double>& state, const std::string& advice) const;

  const CompiledSystem& system_;
  double linear_bound_ = 0.0, angular_bound_ = 0.0;
  double mark_time_ = 0.0;
  std::int64_t mark_work_ = 0;
};

}  // namespace codesign

#endif  // MECHANISM_CODESIGN_INTEGRATION_MOTION_WATCH_H_
