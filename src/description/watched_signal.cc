// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "description/watched_signal.h"

namespace codesign {

bool is_equality(const WatchedSignal& watched) {
  if (watched.role != WatchedSignal::Role::kFinal || !watched.lower || !watched.upper) return false;
  return watched.lower->is_constant() && watched.upper->is_constant() && watched.lower->nominal() == watched.upper->nominal();
}

}  // namespace codesign
