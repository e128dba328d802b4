// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "description/control_realization.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace codesign {

// A delay that is a multiple of the sample time within rounding needs no additional slot.
int ControlRealization::queued() const {
  constexpr double kMost = std::numeric_limits<int>::max();
  return is_sampled() ? static_cast<int>(std::min(std::ceil(delay / sample_time - 1e-9), kMost))
                      : 0;
}

}  // namespace codesign
