// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "equations/equations.h"
#include "integration/applied_work.h"
#include "mechanism_codesign/status.h"

namespace codesign {

/// Ends a run whose motion is unstable, for example with a feedback gain of the wrong sign, before it takes ever shorter steps.
///
/// With `solver.maximum_speed`, the run ends when a body exceeds it. Without this key, the run ends if all of these hold: there is a
/// controller; a body is ten times faster than a typical speed, the largest of the start's, of a fall through the mechanism's size, and of
/// the velocities that setpoints and references prescribe directly or as derivatives of positions, commanded ones too; no effort was
/// commanded; and at the pace of the last 500 steps the study would need more than a tenth of `maximum_steps` (at least 5000). Speeds are
/// |r'| [m/s] and |omega| [rad/s].
class MotionWatch {
 public:
  explicit MotionWatch(const CompiledSystem& system) : system_(system), motion_(system) {}

  /// @param equations must hold the design. @param initial its initial state.
  void start(const Equations<double>& equations, const State<double>& initial);
  /// To be called after each step. @param work number of steps so far, rejected ones included. @returns kUnstableMotion, or ok.
  Status check(const State<double>& state, std::int64_t work);

 private:
  struct Speeds {
    double linear = 0.0, angular = 0.0;  ///< speeds of the fastest bodies [m/s], [rad/s]
    int linear_body = 0, angular_body = 0;
  };
  Speeds speeds(const State<double>& state) const;
  double target(const Equations<double>& equations) const;
  double expected_work(double time, std::int64_t work) const;
  Status exceeded(const State<double>& state, const std::string& advice) const;

  const CompiledSystem& system_;
  BodyMotion motion_;
  double linear_bound_ = 0.0, angular_bound_ = 0.0;
  double mark_time_ = 0.0;
  std::int64_t mark_work_ = 0;
};

}  // namespace codesign
