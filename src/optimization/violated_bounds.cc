// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "optimization/violated_bounds.h"

#include <algorithm>

#include "problem/margins.h"
#include "text/decimal.h"

namespace codesign {

bool meets_constraints(const OptimizationResult& result) {
  return all_met(result.margins) && std::all_of(result.watched.begin(), result.watched.end(),
                                                [](const WatchedResult& watched) { return watched.violation <= kMostViolation; });
}

std::string describe_violated(const std::vector<WatchedResult>& watched) {
  std::string list;
  for (const WatchedResult& result : watched) {
    if (!(result.violation > kMostViolation)) continue;
    list += (list.empty() ? "" : "; ") + result.element + " (" + result.signal + ") goes from " + to_decimal(result.smallest) + " to " +
            to_decimal(result.largest) + ", beyond its bounds by " + to_decimal(result.violation);
  }
  return "no point was found that keeps the bounds of all signals: " + list;
}

}  // namespace codesign
