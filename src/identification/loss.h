// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>

#include "description/identification.h"

namespace codesign {

/// The contribution of a residual to the cost, and its weight in the normal equations.
struct LossValue {
  double value = 0.0;   ///< rho(u)
  double weight = 1.0;  ///< rho'(u) / (2 u), 1 for a sum of squares
};

/// With c = LossOptions::scale: u^2; Huber: u^2 up to |u| = c and c (2 |u| - c) beyond; soft_l1: 2 c^2 (sqrt(1 + (u/c)^2) - 1).
/// @param u a residual divided by the spread of its output's residuals
inline LossValue loss_of(const LossOptions& options, double u) {
  const double c = options.scale;
  switch (options.kind) {
    case LossKind::kNone:
      break;
    case LossKind::kHuber:
      if (std::abs(u) <= c) break;
      return {c * (2.0 * std::abs(u) - c), c / std::abs(u)};
    case LossKind::kSoftL1: {
      const double root = std::sqrt(1.0 + u * u / (c * c));
      return {2.0 * u * u / (1.0 + root), 1.0 / root};
    }
  }
  return {u * u, 1.0};
}

}  // namespace codesign
