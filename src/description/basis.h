// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <vector>

#include "description/quantity.h"

namespace codesign {

/// Degree of the B-splines: 1 or 3.
enum class BasisShape { kLinear, kCubic };

/// A shaped input u(t) = sum_k c_k B_k(t) for 0 <= t <= duration; afterwards the last value is held; theory (C8).
/// B_k are B-splines on equal spans whose end knots are repeated, so that u starts at the first coefficient and ends at the last.
struct BasisDescription {
  BasisShape shape = BasisShape::kLinear;
  double duration = 0.0;               ///< [s]
  std::vector<Quantity> coefficients;  ///< c_k, at least degree() + 1 [unit of u]

  int degree() const { return shape == BasisShape::kLinear ? 1 : 3; }
  int count() const { return static_cast<int>(coefficients.size()); }

  /// The interval of time [s] in which coefficient k has influence; its end is infinite for the last one, which is held.
  std::array<double, 2> support(int k) const;
};

/// The B_k that are not zero at an instant.
struct BasisWeights {
  int first = 0, count = 0;               ///< B_first, ..., B_(first + count - 1)
  std::array<double, 4> value{}, rate{};  ///< B_k and its time derivative [1/s]; the first `count` entries
};

/// The weights at time t [s]; rates are zero after the duration.
BasisWeights basis_weights(const BasisDescription& basis, double t);

}  // namespace codesign
