// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>

namespace codesign {

/// A function of time that the owner of a run can replace during the run: sum c_k (t - start)^k in the unit of the signal, after the first
/// command. After each change the run must be continued by Integrator::go_on(). Not thread-safe.
struct LiveFunction {
  bool commanded = false;  ///< false: the planned function is in effect
  double start = 0.0;      ///< [s]
  std::array<double, 6> c{};
};

}  // namespace codesign
