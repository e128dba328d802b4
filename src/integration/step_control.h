// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "description/motion_study.h"
#include "mechanism_codesign/status.h"
#include "text/number_text.h"

namespace codesign {

/// Step-size control with Gustafsson's prediction, as in the code RODAS of Hairer and Wanner [5].
class StepController {
 public:
  /// @param order the order of the method.
  explicit StepController(int order) : exponent_(1.0 / order) {}

  /// Whether a step of size h [s] with this scaled error is accepted, error <= 1; `proposal`
  /// receives the size of the next attempt [s].
  bool accept(double h, double error, double* proposal) {
    double factor = limit(std::pow(error, exponent_) / kSafety);
    if (!(error <= 1.0)) {
      *proposal = h / (std::isfinite(error) ? std::max(factor, 1.1) : kLargestReduction);
      rejected_ = true;
      return false;
    }
    if (accepted_error_ > 0.0)
      factor = std::max(
          factor,
          limit(accepted_h_ / h * std::pow(error * error / accepted_error_, exponent_) / kSafety));
    if (rejected_) factor = std::max(factor, 1.0);
    accepted_h_ = h;
    accepted_error_ = std::max(1e-2, error);
    rejected_ = false;
    *proposal = h / factor;
    return true;
  }

  /// The next size [s] after an attempt of size h that could not be computed.
  double back_off(double h) {
    rejected_ = true;
    return h / kLargestReduction;
  }

 private:
  static constexpr double kSafety = 0.9, kLargestReduction = 5.0, kLargestGrowth = 6.0;
  static double limit(double factor) {
    return std::max(1.0 / kLargestGrowth, std::min(kLargestReduction, factor));
  }

  double exponent_;
  double accepted_h_ = 0.0, accepted_error_ = 0.0;
  bool rejected_ = false;
};

/// Detects a multistep run that no longer advances because almost every step ends in a restart:
/// near a singular position the drift of one step is beyond its limit at any size that the
/// tolerance allows, and each restart begins with a shorter step.
class RestartPace {
 public:
  void start(double time) {
    began_ = time_ = time;
    steps_ = restarts_ = 0;
  }
  void count_restart() { ++restarts_; }

  /// To be called after each step. @param steps of the run so far. @returns kStepSizeTooSmall if in
  /// the last kWindow steps nearly all were restarts and the time advanced a thousand times less
  /// per step than in the run before; else ok.
  Status check(double time, std::int64_t steps) {
    if (steps - steps_ < kWindow) return {};
    const double advance = time - time_,
                 before = (time_ - began_) / static_cast<double>(steps_ > 0 ? steps_ : 1);
    const bool stands =
        restarts_ > kNearlyAll && advance < kSlow * before * static_cast<double>(steps - steps_);
    const std::int64_t restarts = restarts_;
    time_ = time;
    steps_ = steps;
    restarts_ = 0;
    if (!stands) return {};
    return {StatusCode::kStepSizeTooSmall, time,
            "the run stands still: in the last " + std::to_string(kWindow) +
                " steps the time advanced by " + readable(advance, 3) + " s, and " +
                std::to_string(restarts) +
                " of them left the constraints by more than the tolerance allows, as near a "
                "singular position; take a looser tolerance or "
                "the integrator rosenbrock, or end the study before this position"};
  }

 private:
  static constexpr std::int64_t kWindow = 500, kNearlyAll = 400;
  static constexpr double kSlow = 1e-3;

  double began_ = 0.0, time_ = 0.0;  ///< of the run and of the window
  std::int64_t steps_ = 0, restarts_ = 0;
};

/// The smallest step [s] at time t that rounding allows.
inline double smallest_step(double t, double duration) {
  return 16.0 * std::numeric_limits<double>::epsilon() * std::max(std::abs(t), 1e-3 * duration);
}

/// Where a step at most ends: at the next event, but not so short before the limit that no step
/// could follow, as k times a sample time may lie.
inline double end_of_step(double event, double limit, double smallest) {
  return limit - event < smallest ? limit : event;
}

/// The instants [s] at which a study's functions of time have a kink or begin to move,
/// doc/theory.md (C1). Integrators end a step there: a step across a kink loses its order, and a
/// long step from rest could skip a motion that begins within it. For a function through samples
/// these are the instants of all samples, since its second derivative jumps there; they are shifted
/// by the start value of its delay.
class BreakTimes {
 public:
  explicit BreakTimes(const MotionStudy& study);

  /// The first break time after `t` if it is before `limit`, else `limit`; all in [s].
  double next(double t, double limit) const;
  /// Whether `t` is a break time.
  bool contains(double t) const { return std::binary_search(times_.begin(), times_.end(), t); }
  /// All break times [s], ascending.
  const std::vector<double>& times() const { return times_; }

 private:
  void add(const ReferenceDescription& reference);

  std::vector<double> times_;  ///< ascending
  double apart_;               ///< [s] a break time less than this after t counts as reached
};

}  // namespace codesign
