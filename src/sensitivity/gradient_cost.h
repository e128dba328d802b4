// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace codesign {

// Estimated cost of a gradient, in units of one simulation without gradient; measured on mechanisms of 3 to 16 bodies,
// doc/decisions/0083-transposed-products.md. Lanes are evaluated in groups of eight or four.

/// Cost of direct sensitivities by this number of parameters.
inline double direct_cost(int parameters) {
  constexpr double kSimulation = 1.0, kEight = 2.4, kFour = 1.7;
  double cost = kSimulation;
  for (; parameters > 4; parameters -= 8) cost += kEight;
  return parameters > 0 ? cost + kFour : cost;
}

/// Cost of the adjoint method by any number of parameters.
constexpr double kAdjointCost = 4.0;

}  // namespace codesign
