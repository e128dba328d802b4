// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "description/motion_study.h"

namespace codesign {

/// An event of a sampled controller: it reads its input and computes an output, or an output comes
/// into effect.
struct ControlEvent {
  enum class Kind { kSample, kApply };
  Kind kind = Kind::kSample;
  int controller = 0;       ///< index in Study::controllers
  std::int64_t sample = 0;  ///< number of the sample, from 0
};

/// The instants of the sampled controllers of a study, theory (51): samples at k T, outputs in
/// effect at k T + delay, k = 0, 1, ... Times are multiples of T, not sums, so that no error
/// accumulates. The samples at t = 0 belong to the assembled start.
class ControlClock {
 public:
  explicit ControlClock(const MotionStudy& study);

  bool is_empty() const { return controllers_.empty(); }
  /// Begins at t = 0, after the samples at t = 0.
  void start();
  /// The time of the next event [s] if it is before `limit`, else `limit`.
  double next(double limit) const;
  /// Removes and returns the events up to time t [s]. At one instant, first the outputs come into
  /// effect, then the samples follow in the order of the controllers. Valid until the next call.
  const std::vector<ControlEvent>& due(double t);

 private:
  struct Sampled {
    int controller;
    double period, delay;        ///< [s]
    std::int64_t sample, apply;  ///< numbers of the next sample and of the next output
    double next() const;
    // Late in a run the rounding of both times exceeds a fraction of a short period, and no step is
    // as short as that rounding.
    bool is_reached(double time, double t) const {
      return time <= t + std::max(1e-9 * period, 1e-14 * t);
    }
  };

  std::vector<Sampled> controllers_;
  std::vector<ControlEvent> events_;
};

}  // namespace codesign
