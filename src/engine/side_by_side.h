// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <functional>

#include "description/ensemble.h"

namespace codesign {

/// Calls work(k) for k = 0 to count - 1, at most `threads` calls at the same time; the calls begin in the order of k. Meant for work that
/// mostly waits for an engine. With one thread, all calls are made in the thread of the caller. If a call throws, no further call begins,
/// and the exception is thrown again after the running calls have ended.
void side_by_side(std::size_t count, int threads, const std::function<void(std::size_t)>& work);

/// Number of threads of this process that the options of an engine request, at least one. With kMpi each process uses all processors.
int worker_threads(const EngineOptions& engine);

}  // namespace codesign
