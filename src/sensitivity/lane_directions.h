// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <new>

#include "math/lanes.h"
#include "math/line_vector.h"
#include "math/span.h"

namespace codesign {

/// N directional derivatives of a vector: an N x size matrix with one column per component, in memory aligned to cache lines.
template <int N>
class Directions : public Eigen::Map<Eigen::Matrix<double, N, Eigen::Dynamic>> {
 public:
  using Map = Eigen::Map<Eigen::Matrix<double, N, Eigen::Dynamic>>;
  using Vector = typename Lanes<N>::Vector;

  /// All zero.
  explicit Directions(Eigen::Index columns = 0) : Map(nullptr, N, 0) { resize(columns); }
  Directions(const Directions& other) : Map(nullptr, N, 0) { *this = other; }
  Directions& operator=(const Directions& other) {
    resize(other.cols());
    Map::operator=(other);
    return *this;
  }

  /// A change of the number of columns sets all entries to zero.
  void resize(Eigen::Index columns) {
    if (columns == this->cols()) return;
    numbers_.assign(static_cast<std::size_t>(N * columns), 0.0);
    new (static_cast<Map*>(this)) Map(numbers_.data(), N, columns);
  }

  /// The N derivatives of one component as a vector of the processor.
  Vector& vector(int column) { return *reinterpret_cast<Vector*>(this->data() + N * column); }
  const Vector& vector(int column) const { return *reinterpret_cast<const Vector*>(this->data() + N * column); }

  /// The derivatives of `count` components from the `first` on, N side by side for each.
  Span<double> part(int first, int count) { return Span<double>(numbers_).subspan(N * first, N * count); }
  Span<const double> part(int first, int count) const { return Span<const double>(numbers_).subspan(N * first, N * count); }

 private:
  LineVector numbers_;
};

}  // namespace codesign
