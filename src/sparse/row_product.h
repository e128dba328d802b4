// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cassert>
#include <cstddef>
#include <vector>

#include "math/span.h"
#include "sparse/sparsity.h"

namespace codesign {

/// One row of a sparse matrix times the vector x (pattern.columns).
template <class T>
T row_product(const Sparsity& pattern, const std::vector<T>& values, int row, In<T> x) {
  assert(x.size() == pattern.columns);
  T sum(0.0);
  const T* const factor = x.data();
  const int* const column = pattern.column_index.data();
  for (int e = pattern.first(row); e < pattern.first(row + 1); ++e) sum += values[static_cast<std::size_t>(e)] * factor[column[e]];
  return sum;
}

/// One row of a real sparse matrix A times N vectors that are stored row by row: sum_k += sum over columns c of A(row, c) x[N c + k].
template <int N>
void add_row_product(const Sparsity& pattern, const std::vector<double>& values, int row, In<double> x, typename Lanes<N>::Vector* sum) {
  assert(x.size() == std::ptrdiff_t{N} * pattern.columns);
  using Vector = typename Lanes<N>::Vector;
  const int* const column = pattern.column_index.data();
  const double* const first = x.data();
  for (int e = pattern.first(row); e < pattern.first(row + 1); ++e)
    *sum += values[static_cast<std::size_t>(e)] * *reinterpret_cast<const Vector*>(first + std::ptrdiff_t{N} * column[e]);
}

/// One row of N directional derivatives d_k A of a sparse matrix times M real vectors, which are read from index `offset` on:
/// sums[m]_k += sum over columns c of d_k A(row, c) x[m][offset + c].
/// @param derivatives N numbers per entry of the pattern, side by side.
template <int N, std::size_t M>
void add_row_tangents(const Sparsity& pattern, In<double> derivatives, int row, const In<double> (&x)[M], int offset,
                      typename Lanes<N>::Vector (&sums)[M]) {
  assert(derivatives.size() == std::ptrdiff_t{N} * pattern.nonzeros());
  const int* const column = pattern.column_index.data();
  const double *const changes = derivatives.data(), *from[M];
  typename Lanes<N>::Vector total[M];
  for (std::size_t m = 0; m < M; ++m) {
    assert(x[m].size() >= offset + pattern.columns);
    from[m] = x[m].data();
    total[m] = sums[m];
  }
  for (int e = pattern.first(row); e < pattern.first(row + 1); ++e) {
    const auto& change = *reinterpret_cast<const typename Lanes<N>::Vector*>(changes + std::ptrdiff_t{N} * e);
    const int k = offset + column[e];
    for (std::size_t m = 0; m < M; ++m) total[m] += from[m][k] * change;
  }
  for (std::size_t m = 0; m < M; ++m) sums[m] = total[m];
}

}  // namespace codesign
