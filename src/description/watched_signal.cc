// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "description/watched_signal.h"

#include "text/decimal.h"

namespace codesign {

bool is_equality(const WatchedSignal& watched) {
  if (watched.role != WatchedSignal::Role::kFinal || !watched.lower || !watched.upper) return false;
  return watched.lower->is_constant() && watched.upper->is_constant() && watched.lower->nominal() == watched.upper->nominal();
}

void require_ordered_bounds(const WatchedSignal& watched, const std::vector<double>& parameters) {
  if (!watched.lower || !watched.upper) return;
  const double lower = watched.lower->at(parameters), upper = watched.upper->at(parameters);
  const bool equal_allowed = watched.role == WatchedSignal::Role::kFinal;
  if (lower < upper || (lower == upper && equal_allowed)) return;
  throw InputError({watched.where, watched.element, "the lower bound must be less than the upper one",
                    to_decimal(lower) + ", " + to_decimal(upper), equal_allowed ? "lower <= upper" : "lower < upper"});
}

}  // namespace codesign
