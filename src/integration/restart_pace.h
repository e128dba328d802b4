// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>

#include "mechanism_codesign/status.h"
#include "text/number_text.h"

namespace codesign {

/// Detects a multistep run that no longer advances because almost every step ends in a restart: near a singular position the drift of one
/// step is beyond its limit at any size that the tolerance allows, and each restart begins with a shorter step.
class RestartPace {
 public:
  void start(double time) {
    began_ = time_ = time;
    steps_ = restarts_ = 0;
  }
  void count_restart() { ++restarts_; }

  /// To be called after each step. @param steps of the run so far. @returns kStepSizeTooSmall if in the last kWindow steps nearly all were
  /// restarts and the time advanced a thousand times less per step than in the run before; else ok.
  Status check(double time, std::int64_t steps) {
    if (steps - steps_ < kWindow) return {};
    const double advance = time - time_, before = (time_ - began_) / static_cast<double>(steps_ > 0 ? steps_ : 1);
    const bool stands = restarts_ > kNearlyAll && advance < kSlow * before * static_cast<double>(steps - steps_);
    const std::int64_t restarts = restarts_;
    time_ = time;
    steps_ = steps;
    restarts_ = 0;
    if (!stands) return {};
    return {StatusCode::kStepSizeTooSmall, time,
            "the run stands still: in the last " + std::to_string(kWindow) + " steps the time advanced by " + readable(advance, 3) +
                " s, and " + std::to_string(restarts) +
                " of them left the constraints by more than the tolerance allows, as near a singular position; take a looser tolerance or "
                "the integrator rosenbrock, or end the study before this position"};
  }

 private:
  static constexpr std::int64_t kWindow = 500, kNearlyAll = 400;
  static constexpr double kSlow = 1e-3;

  double began_ = 0.0, time_ = 0.0;  ///< of the run and of the window
  std::int64_t steps_ = 0, restarts_ = 0;
};

}  // namespace codesign
