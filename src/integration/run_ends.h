// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>

#include "equations/compiled_system.h"
#include "equations/equations.h"
#include "integration/run_watch.h"
#include "mechanism_codesign/frame.h"
#include "mechanism_codesign/simulation.h"
#include "mechanism_codesign/status.h"

namespace codesign {

/// Ends a run whose motion is unstable, for example with a feedback gain of the wrong sign, before
/// it takes ever shorter steps.
///
/// With `solver.maximum_speed`, the run ends when a body exceeds it. Without this key, the run ends
/// if all of these hold: there is a controller; a body is ten times faster than a typical speed,
/// the largest of the start's, of a fall through the mechanism's size, and of the velocities that
/// setpoints and references prescribe directly or as derivatives of positions, commanded ones too;
/// no effort was commanded; and at the pace of the last 500 steps the study would need more than a
/// tenth of `maximum_steps` (at least 5000). Speeds are |r'| [m/s] and |omega| [rad/s].
class MotionWatch {
 public:
  explicit MotionWatch(const CompiledSystem& system) : system_(system), motion_(system) {}

  /// @param equations must hold the design. @param initial its initial state.
  void start(const Equations<double>& equations, const State<double>& initial);
  /// To be called after each step. @param work number of steps so far, rejected ones included.
  /// @returns kUnstableMotion, or ok.
  Status check(const State<double>& state, std::int64_t work);
  /// What a failure of the solver means where the motion has run away, as under a load that grows
  /// with it: kUnstableMotion if bodies are ten thousand times as fast as is typical, unless a
  /// given motion, which does any work, drives them; else `status`.
  Status judge_failure(const Status& status, const State<double>& state) const;

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
  double typical_linear_ = 0.0, typical_angular_ = 0.0;  ///< [m/s], [rad/s]
  double mark_time_ = 0.0;
  std::int64_t mark_work_ = 0;
};

/// Detects a run that stalls, with ever shorter steps, before a singular position; doc/theory.md
/// (17c). To be called after each step.
///
/// Near such a position reactions grow as one over the smallest singular value of Phi_q, and so
/// does friction that depends on them. Only mechanisms with dropped redundant rows are checked,
/// since otherwise the compliance leads past the position. Of their runs, only those that failed or
/// whose steps are very short are checked, so that other runs cost nothing.
/// @param status of the step. @param initial state of the run. @param state at the end of the last
/// step. @param step_size its size [s].
/// @param equations must hold the design.
/// @returns kSingularConfiguration, with rank and joints in its cause, if the run is at a singular
/// position and either failed there or would need more than 20,000 further steps; else `status`.
Status judge_standstill(const Status& status, const CompiledSystem& system,
                        const State<double>& initial, const State<double>& state, double step_size,
                        const Statistics& statistics, Equations<double>* equations);

/// The sentence for a run whose matrix becomes singular, with the joints that rub and may have
/// jammed. @param equations must hold the design.
std::string singular_sentence(const CompiledSystem& system, const State<double>& state,
                              Equations<double>* equations);

/// A sentence that names the first joint, friction, controller, link or signal of a frame with a
/// value that is not finite; empty if there is none.
std::string find_not_finite(const FrameNames& names, const Frame& frame);

}  // namespace codesign
