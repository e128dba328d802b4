// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_ENGINE_SIDE_BY_SIDE_H_
#define MECHANISM_CODESIGN_ENGINE_SIDE_BY_SIDE_H_

#include <cstddef>
#include <functional>

#include "description/ensemble.h"

namespace codesign {

/// Calls work(k) for k = 0 to count - 1, up to `threads` calls at the same time, in ascending order of their beginning. For work that
/// mostly waits for an engine. With one thread the calls are in the thread of the caller. An exception of a call is thrown again once all
/// calls that had begun have ended; no further ones begin.
void side_by_side(std::size_t count, int threads, const std::function<void(std::size_t)>& work);

/// How many threads of this process an engine's options ask for, at least one; the processes of kMpi each work with all processors.
int worker_threads(const EngineOptions& engine);

}  // namespace codesign

#endif  // MECHANISM_CODESIGN_ENGINE_SIDE_BY_SIDE_H_
