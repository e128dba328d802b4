// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cassert>
#include <cstddef>
#include <vector>

#include "math/arrays.h"
#include "math/scalar.h"

namespace codesign {

/// The pattern of a sparse matrix in compressed-row form; column indices ascend within each row.
struct Sparsity {
  int rows = 0, columns = 0;
  /// index of the first nonzero of each row (rows + 1 of them); column of each nonzero
  std::vector<int> row_start, column_index;

  int nonzeros() const { return static_cast<int>(column_index.size()); }
  int first(int row) const { return row_start[to_index(row)]; }
  int column(int entry) const { return column_index[to_index(entry)]; }
};

/// One object for each group of variables that the equations are differentiated by: positions (q,
/// s), velocities v, rates z = (a, lambda, sigma); theory (14).
template <class X>
struct ByVariable {
  X position, velocity, rate;
};

/// The derivatives of the equations, theory (14): the nonzeros of three sparse matrices (position:
/// G_q and G_s, velocity: G_v, rate: G_z), and the partial derivative by time.
template <class T>
struct Linearization : ByVariable<std::vector<T>> {
  VectorX<T> time;  ///< G_t, then g_t; units of the rows per second

  void resize(const ByVariable<Sparsity>& patterns) {
    this->position.resize(patterns.position.column_index.size());
    this->velocity.resize(patterns.velocity.column_index.size());
    this->rate.resize(patterns.rate.column_index.size());
    time.setZero(patterns.rate.rows);
  }
};

/// The sparse gradient of a scalar by positions, velocities, rates and time. A column may occur
/// several times; its entries add up. clear() keeps the memory.
template <class T>
struct SparseGradient {
  struct Entry {
    int column;
    T value;
  };
  using Entries = std::vector<Entry>;
  Entries position, velocity, rate;
  T time{0.0};

  void clear() {
    for (Entries* entries : {&position, &velocity, &rate}) entries->clear();
    time = T(0.0);
  }
};

/// One row of a sparse matrix times the vector x (pattern.columns).
template <class T>
T row_product(const Sparsity& pattern, const std::vector<T>& values, int row, In<T> x) {
  assert(x.size() == pattern.columns);
  T sum(0.0);
  const T* const factor = x.data();
  const int* const column = pattern.column_index.data();
  for (int e = pattern.first(row); e < pattern.first(row + 1); ++e)
    sum += values[to_index(e)] * factor[column[e]];
  return sum;
}

/// One row of a real sparse matrix A times N vectors that are stored row by row: sum_k += sum over
/// columns c of A(row, c) x[N c + k].
template <int N>
void add_row_product(const Sparsity& pattern, const std::vector<double>& values, int row,
                     In<double> x, typename Lanes<N>::Vector* sum) {
  assert(x.size() == std::ptrdiff_t{N} * pattern.columns);
  using Vector = typename Lanes<N>::Vector;
  const int* const column = pattern.column_index.data();
  const double* const first = x.data();
  for (int e = pattern.first(row); e < pattern.first(row + 1); ++e)
    *sum += values[to_index(e)] *
            *reinterpret_cast<const Vector*>(first + std::ptrdiff_t{N} * column[e]);
}

/// One row of N directional derivatives d_k A of a sparse matrix times M real vectors, which are
/// read from index `offset` on: sums[m]_k += sum over columns c of d_k A(row, c) x[m][offset + c].
/// @param derivatives N numbers per entry of the pattern, side by side.
template <int N, std::size_t M>
void add_row_tangents(const Sparsity& pattern, In<double> derivatives, int row,
                      const In<double> (&x)[M], int offset, typename Lanes<N>::Vector (&sums)[M]) {
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
    const auto& change =
        *reinterpret_cast<const typename Lanes<N>::Vector*>(changes + std::ptrdiff_t{N} * e);
    const int k = offset + column[e];
    for (std::size_t m = 0; m < M; ++m) total[m] += from[m][k] * change;
  }
  for (std::size_t m = 0; m < M; ++m) sums[m] = total[m];
}

/// The rows first, ..., last - 1 of a sparse matrix.
struct RowRange {
  int first, last;
};

/// x += factor A^T y over these rows of A. `y` is indexed by the rows of A, `x` by its columns;
/// other rows of y are not read.
inline void add_transposed_product(const Sparsity& pattern, const std::vector<double>& values,
                                   RowRange rows, double factor, In<double> y, Out<double> x) {
  assert(y.size() == pattern.rows && x.size() == pattern.columns);
  const double* const multiplier = y.data();
  double* const sum = x.data();
  const int* const column = pattern.column_index.data();
  for (int row = rows.first; row < rows.last; ++row) {
    const double scaled = factor * multiplier[row];
    if (scaled == 0.0) continue;
    for (int e = pattern.first(row); e < pattern.first(row + 1); ++e)
      sum[column[e]] += scaled * values[to_index(e)];
  }
}

}  // namespace codesign
