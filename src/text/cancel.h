// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <atomic>

namespace codesign {

/// Whether a computation is to end early. @param cancel may be set from any thread; null: never.
inline bool is_set(const std::atomic<bool>* cancel) { return cancel != nullptr && *cancel; }

}  // namespace codesign
