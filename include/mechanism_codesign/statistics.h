// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_STATISTICS_H_
#define MECHANISM_CODESIGN_STATISTICS_H_

#include <cstdint>

namespace codesign {

/// The cost and the accuracy of an integration.
struct Statistics {
  std::int64_t steps = 0, rejected_steps = 0;
  double cpu_seconds = 0.0;       ///< of the run
  double constraint_drift = 0.0;  ///< largest violation of Phi and of Phi_q v after a step, in the scale of the error test [-]
  double energy_error = 0.0;      ///< largest |E - E(0) - work done| over the run, relative to the largest energy that took part [-]
};

}  // namespace codesign

#endif  // MECHANISM_CODESIGN_STATISTICS_H_
