// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_DESCRIPTION_BASIS_H_
#define MECHANISM_CODESIGN_DESCRIPTION_BASIS_H_

#include <array>
#include <vector>

#include "description/quantity.h"

namespace codesign {

enum class BasisShape { kLinear, kCubic };

/// A shaped input u(t) = sum_k c_k B_k(t) over [0, duration], its last value held from there on; theory (C8).
/// B_k are B-splines on equal spans whose end knots are repeated, so that u starts at the first coefficient and ends at the last.
struct BasisDescription {
  BasisShape shape = BasisShape::kLinear;
  double duration = 0.0;               ///< [s]
  std::vector<Quantity> coefficients;  ///< more than degree() of them

  int degree() const { return shape == BasisShape::kLinear ? 1 : 3; }
  int count() const { return static_cast<int>(coefficients.size()); }

  /// The times [s] from first to second in which coefficient k has any influence; infinity where the last value is held.
  std::array<double, 2> support(int k) const;
};

/// The B_k that do not vanish at an instant, and their rates [1/s].
struct BasisWeights {
  int first = 0, count = 0;  ///< B_first, ..., B_(first + count - 1)
  std::array<double, 4> value{}, rate{};
};

BasisWeights basis_weights(const BasisDescription& basis, double t);

}  // namespace codesign

#endif  // MECHANISM_CODESIGN_DESCRIPTION_BASIS_H_
