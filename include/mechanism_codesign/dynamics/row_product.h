// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_DYNAMICS_ROW_PRODUCT_H_
#define MECHANISM_CODESIGN_DYNAMICS_ROW_PRODUCT_H_

#include "mechanism_codesign/dynamics/sparsity.h"

namespace codesign {

/// One row of a sparse matrix times a vector.
template <class T>
T row_product(const Sparsity& pattern, const std::vector<T>& values, int row, const T* x) {
  T sum(0.0);
  const int* const column = pattern.column_index.data();
  for (int e = pattern.first(row); e < pattern.first(row + 1); ++e) sum += values[static_cast<std::size_t>(e)] * x[column[e]];
  return sum;
}

/// One row of a real sparse matrix times N vectors, stored row by row: sum[k] += sum over the row of values x[N column + k].
template <int N>
void add_row_product(const Sparsity& pattern, const std::vector<double>& values, int row, const double* x, double* sum) {
  const int* const column = pattern.column_index.data();
  for (int e = pattern.first(row); e < pattern.first(row + 1); ++e) {
    const double value = values[static_cast<std::size_t>(e)];
    const double* const y = x + N * column[e];
    for (int k = 0; k < N; ++k) sum[k] += value * y[k];
  }
}

/// One row of the directional derivatives of a sparse matrix times a real vector: sum[k] += sum over the row of dvalues_k x[column].
template <int N>
void add_row_tangent(const Sparsity& pattern, const std::vector<Lanes<N>>& values, int row, const double* x, double* sum) {
  const int* const column = pattern.column_index.data();
  for (int e = pattern.first(row); e < pattern.first(row + 1); ++e) {
    const double factor = x[column[e]];
    const double* const d = values[static_cast<std::size_t>(e)].directions().data();
    for (int k = 0; k < N; ++k) sum[k] += factor * d[k];
  }
}

}  // namespace codesign

#endif  // MECHANISM_CODESIGN_DYNAMICS_ROW_PRODUCT_H_
