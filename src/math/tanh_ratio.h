// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>

#include "math/scalar.h"

namespace codesign {

/// tanh(sqrt x)/sqrt x for x >= 0: analytic in x, 1 at zero; theory (13a). Below x = 0.05 the series of the hyperbolic
/// tangent is used, so that the relative errors of the value and of its derivative stay below 1e-14.
template <class T>
T tanh_ratio(const T& x) {
  using std::sqrt;
  using std::tanh;
  constexpr double kSeriesBelow = 0.05;  // the series' terms fall like (4 x/pi^2)^k
  constexpr double kSeries[] = {1.0,
                                -1.0 / 3.0,
                                2.0 / 15.0,
                                -17.0 / 315.0,
                                62.0 / 2835.0,
                                -1382.0 / 155925.0,
                                21844.0 / 6081075.0,
                                -929569.0 / 638512875.0,
                                6404582.0 / 10854718875.0,
                                -443861162.0 / 1856156927625.0,
                                18888466084.0 / 194896477400625.0};
  if (!is_less(x, T(kSeriesBelow), false)) {
    const T root = sqrt(x);
    return tanh(root) / root;
  }
  T sum(kSeries[10]);
  for (int k = 9; k >= 0; --k) sum = sum * x + T(kSeries[k]);
  return sum;
}

}  // namespace codesign
