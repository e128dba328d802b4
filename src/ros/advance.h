// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mechanism_codesign/simulation.h"

namespace codesign {

/// Advances a run from time `from` to `to` [s] and calls `stop()` sixteen times on the way, since this may take long. The division does not
/// change the steps of the integrator. @returns kCancelled if `stop()` was true, else the status of the run.
template <class Stop>
Status advance(Simulation* simulation, double from, double to, Stop&& stop) {
  constexpr int kSlices = 16;
  Status status;
  for (int k = 1; k <= kSlices && status.ok(); ++k) {
    const double time = k == kSlices ? to : from + (to - from) * k / kSlices;
    if (stop()) return {StatusCode::kCancelled, time, "cancelled"};
    status = simulation->advance(time);
  }
  return status;
}

}  // namespace codesign
