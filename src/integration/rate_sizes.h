// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <vector>

#include "math/arrays.h"
#include "math/scalar.h"
#include "system/state.h"

namespace codesign {

/// The sizes against which the errors of velocities of a Rosenbrock step are judged: of each
/// velocity its own magnitude, of the rate of an Euler parameter the length of all four. A body
/// that spins takes each of these through zero twice a turn, where its own magnitude says nothing,
/// in any axes.
class RateSizes {
 public:
  explicit RateSizes(const Layout& layout) : euler_(to_index(layout.n), -1) {
    for (int body = 0; body < layout.bodies; ++body) {
      if (!layout.is_free(body)) continue;
      const int first = layout.column(body) + 3;
      for (int k = first; k < first + 4; ++k) euler_[to_index(k)] = first;
    }
  }

  /// @param v velocities, any vector whose entry k is the magnitude of velocity k.
  template <class Vector>
  double of(const Vector& v, Eigen::Index k) const {
    const int first = euler_[to_index(static_cast<int>(k))];
    if (first < 0) return std::abs(value_of(v[k]));
    double square = 0.0;
    for (int p = first; p < first + 4; ++p) square += value_of(v[p]) * value_of(v[p]);
    return std::sqrt(square);
  }

 private:
  std::vector<int> euler_;  ///< per velocity: that of the first Euler parameter of its body, or -1
};

}  // namespace codesign
