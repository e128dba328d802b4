// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_DYNAMICS_SPARSITY_H_
#define MECHANISM_CODESIGN_DYNAMICS_SPARSITY_H_

#include <algorithm>
#include <utility>
#include <vector>

#include "mechanism_codesign/math/scalar.h"

namespace codesign {

/// A fixed pattern in compressed-column form; rows ascend within each column.
struct Sparsity {
  int rows = 0, columns = 0;
  std::vector<int> column_start, row_index;

  int nonzeros() const { return static_cast<int>(row_index.size()); }
};

/// Notes which entries an assembly touches, in its order.
class PatternRecorder {
 public:
  template <class T>
  void add(int row, int column, const T&, const T&, const T&) {
    calls_.emplace_back(column, row);
  }

  /// The pattern, and for each call in order the slot it adds to.
  Sparsity build(int rows, int columns, std::vector<int>* slots) const;

 private:
  std::vector<std::pair<int, int>> calls_;
};

/// The three partial derivatives of the equations on one pattern: by positions (q, s), by velocities v, and by rates z = (a, lambda, sigma).
template <class T>
struct Linearization {
  std::vector<T> by_position, by_velocity, by_rate;

  void resize(int nonzeros) {
    for (std::vector<T>* values : {&by_position, &by_velocity, &by_rate}) values->resize(static_cast<std::size_t>(nonzeros));
  }
};

/// Adds values to the slots that a PatternRecorder found for the same sequence of calls.
template <class T>
class AssemblySink {
 public:
  AssemblySink(const std::vector<int>& slots, Linearization<T>* values) : slot_(slots.data()), values_(values) {
    for (std::vector<T>* v : {&values->by_position, &values->by_velocity, &values->by_rate}) std::fill(v->begin(), v->end(), T(0.0));
  }

  void add(int, int, const T& by_position, const T& by_velocity, const T& by_rate) {
    const auto k = static_cast<std::size_t>(*slot_++);
    values_->by_position[k] += by_position;
    values_->by_velocity[k] += by_velocity;
    values_->by_rate[k] += by_rate;
  }

 private:
  const int* slot_;
  Linearization<T>* values_;
};

/// Derivative of a scalar with respect to one column's position, velocity and rate.
template <class T>
struct GradientEntry {
  int column;
  T by_position, by_velocity, by_rate;
};

/// A sparse gradient; clear() keeps its memory.
template <class T>
using SparseGradient = std::vector<GradientEntry<T>>;

/// Multiplies the entries from index `first` on.
template <class T>
void scale_from(std::size_t first, const T& factor, SparseGradient<T>* gradient) {
  for (std::size_t k = first; k < gradient->size(); ++k) {
    GradientEntry<T>& e = (*gradient)[k];
    e = {e.column, T(factor * e.by_position), T(factor * e.by_velocity), T(factor * e.by_rate)};
  }
}

}  // namespace codesign

#endif  // MECHANISM_CODESIGN_DYNAMICS_SPARSITY_H_
