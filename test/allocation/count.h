// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

namespace codesign {

/// How often this program has allocated memory so far, by malloc(), calloc(), realloc() or
/// memalign(); operator new and Eigen call these.
std::int64_t allocations();

}  // namespace codesign
