// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cassert>
#include <cstddef>
#include <vector>

#include "math/span.h"
#include "sparse/sparsity.h"

namespace codesign {

/// The rows first, ..., last - 1 of a sparse matrix.
struct RowRange {
  int first, last;
};

/// x += factor A^T y over these rows of A. `y` is indexed by the rows of A, `x` by its columns; other rows of y are not read.
inline void add_transposed_product(const Sparsity& pattern, const std::vector<double>& values, RowRange rows, double factor, In<double> y,
                                   Out<double> x) {
  assert(y.size() == pattern.rows && x.size() == pattern.columns);
  const double* const multiplier = y.data();
  double* const sum = x.data();
  const int* const column = pattern.column_index.data();
  for (int row = rows.first; row < rows.last; ++row) {
    const double scaled = factor * multiplier[row];
    if (scaled == 0.0) continue;
    for (int e = pattern.first(row); e < pattern.first(row + 1); ++e) sum[column[e]] += scaled * values[static_cast<std::size_t>(e)];
  }
}

}  // namespace codesign
