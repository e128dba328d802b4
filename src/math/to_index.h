// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>

namespace codesign {

/// A number that is known not to be negative, as an index of the standard library's containers.
constexpr std::size_t to_index(int k) { return static_cast<std::size_t>(k); }

}  // namespace codesign
