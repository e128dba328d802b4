// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_STATISTICS_H_
#define MECHANISM_CODESIGN_STATISTICS_H_

#include <cstdint>

namespace codesign {

/// The cost and the accuracy of an integration.
struct Statistics {
  std::int64_t steps = 0, rejected_steps = 0;  ///< accepted and rejected steps
  double cpu_seconds = 0.0;                    ///< processor time of the run
  double constraint_drift =
      0.0;  ///< largest drift of positions and velocities after a step, d of theory (17a), in the scale of the error test [-]
  double energy_error = 0.0;  ///< largest error of the energy balance, e of theory (17a) [-]
};

}  // namespace codesign

#endif  // MECHANISM_CODESIGN_STATISTICS_H_
