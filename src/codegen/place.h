// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace codesign {

/// The place of a number: an index into one of the arrays that compiled code works on. Absent if array < 0.
struct Place {
  int array = -1, index = 0;

  friend bool operator==(const Place& x, const Place& y) { return x.array == y.array && x.index == y.index; }
};

/// The number of arrays that compiled code can address.
constexpr int kCodeArrays = 11;

}  // namespace codesign
