// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "optimization/violated_bounds.h"

#include <algorithm>
#include <cmath>

#include "problem/margins.h"
#include "text/decimal.h"

namespace codesign {

double tolerance_of_range(const WatchedResult& watched) {
  double range = 0.0;
  for (const double value :
       {watched.initial_smallest, watched.initial_largest, watched.smallest, watched.largest, watched.lower, watched.upper})
    if (std::isfinite(value)) range = std::max(range, std::abs(value));
  return std::max(kMostViolation, kShareOfRange * range);
}

bool meets_constraints(const OptimizationResult& result) {
  return all_met(result.margins) && std::all_of(result.watched.begin(), result.watched.end(),
                                                [](const WatchedResult& watched) { return watched.violation <= watched.tolerance; });
}

std::string describe_violated(const std::vector<WatchedResult>& watched) {
  std::string list;
  for (const WatchedResult& result : watched) {
    if (!(result.violation > result.tolerance)) continue;
    list += (list.empty() ? "" : "; ") + result.element + " (" + result.signal + ") goes from " + to_decimal(result.smallest) + " to " +
            to_decimal(result.largest) + ", beyond its bounds by " + to_decimal(result.violation) +
            " (tolerance: " + to_decimal(result.tolerance) + ")";
  }
  return "no point was found that keeps the bounds of all signals: " + list;
}

}  // namespace codesign
