// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "cli/progress_line.h"

#include <algorithm>

namespace codesign::cli {

bool LinePace::admits(double seconds) {
  if (lines_ >= kLines && seconds - last_ < std::max(1.0, 0.01 * seconds)) return false;
  lines_ = std::min(lines_ + 1, kLines);
  last_ = seconds;
  return true;
}

}  // namespace codesign::cli
