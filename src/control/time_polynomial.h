// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>

#include "control/reference_motion.h"

namespace codesign {

/// The polynomial sum c_k (t - start)^k for t >= start.
template <class T>
struct TimePolynomial {
  double start;  ///< [s]
  std::array<T, 6> c;

  ReferenceMotion<T> at(double t) const {
    ReferenceMotion<T> motion;
    // Not a T: products with a plain number cost half as much with lanes.
    const double x = t - start;
    for (std::size_t k = c.size(); k-- > 0;) {
      motion.jerk = motion.jerk * x + 3.0 * motion.acceleration;
      motion.acceleration = motion.acceleration * x + 2.0 * motion.rate;
      motion.rate = motion.rate * x + motion.value;
      motion.value = motion.value * x + c[k];
    }
    return motion;
  }

  /// The integral over this time [s] from the start on.
  T area(double duration) const {
    T sum(0.0);
    for (std::size_t k = c.size(); k-- > 0;)
      sum = sum * duration + c[k] * (1.0 / static_cast<double>(k + 1));
    return sum * duration;
  }
};

}  // namespace codesign
