// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "math/scalar.h"

namespace codesign {

/// The pattern of a sparse matrix in compressed-row form; column indices ascend within each row.
struct Sparsity {
  int rows = 0, columns = 0;
  std::vector<int> row_start, column_index;  ///< index of the first nonzero of each row (rows + 1 of them); column of each nonzero

  int nonzeros() const { return static_cast<int>(column_index.size()); }
  int first(int row) const { return row_start[static_cast<std::size_t>(row)]; }
  int column(int entry) const { return column_index[static_cast<std::size_t>(entry)]; }
};

/// One object for each group of variables that the equations are differentiated by: positions (q, s), velocities v, rates
/// z = (a, lambda, sigma); theory (14).
template <class X>
struct ByVariable {
  X position, velocity, rate;
};

/// The derivatives of the equations, theory (14): the nonzeros of three sparse matrices (position: G_q and G_s, velocity: G_v, rate: G_z),
/// and the partial derivative by time.
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

/// The sparse gradient of a scalar by positions, velocities, rates and time. A column may occur several times; its entries add up. clear()
/// keeps the memory.
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

}  // namespace codesign
