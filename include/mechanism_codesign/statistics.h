// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstdint>

namespace codesign {

/// The cost and the accuracy of an integration.
struct Statistics {
  std::int64_t steps = 0, rejected_steps = 0;  ///< accepted and rejected steps
  double cpu_seconds = 0.0;                    ///< processor time of the run
  /// largest drift of positions and velocities after a step, d of theory (17a), in the scale of the
  /// error test [-]
  double constraint_drift = 0.0;
  double energy_error = 0.0;        ///< largest error of the energy balance, e of theory (17a) [-]
  std::int64_t explicit_steps = 0;  ///< those of the accepted steps that the explicit pair took

  /// Adds another run: steps and processor time add up, drift and energy error are the largest of
  /// both.
  Statistics& operator+=(const Statistics& other) {
    steps += other.steps;
    rejected_steps += other.rejected_steps;
    explicit_steps += other.explicit_steps;
    cpu_seconds += other.cpu_seconds;
    constraint_drift = std::max(constraint_drift, other.constraint_drift);
    energy_error = std::max(energy_error, other.energy_error);
    return *this;
  }
};

}  // namespace codesign
