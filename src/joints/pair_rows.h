// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <vector>

#include "joints/joint_law.h"
#include "joints/scalar_product.h"
#include "math/to_index.h"

namespace codesign {

/// The constraint row scale * (X . Y - offset) = 0; theory (6).
template <class T>
struct ProductRow {
  PairVector<T> X, Y;
  T offset{0.0};
  double scale = 1.0;
};

/// The constraint rows of a kinematic pair: if `coincident`, three rows for coincident points, in ground axes; then scalar products;
/// doc/theory.md (5), (6).
///
/// Directions and planes belong to body i, so that the multipliers are components of the paper's F'' and T'' in the joint axes of i, theory
/// (11); the child feels -F'' and -T''. Rows (x_i . d, y_i . d) give F'' = (lambda_1, lambda_2, 0); rows (x_i . z_j, y_i . z_j, y_i . x_j)
/// give T'' = (-lambda_2, lambda_1, lambda_3).
template <class T>
struct PairRows {
  /// The shared vectors: joint axes x, y, z (0 to 2) and the joint point (3) of each body.
  static constexpr int kPoint = 3, kVectors = 8;
  static constexpr int shared(Side side, int k) { return (side == Side::kI ? 0 : 4) + k; }

  bool coincident = false;
  std::array<VectorTerm<T>, kVectors> vectors;
  std::array<bool, kVectors> used{};
  std::vector<ProductRow<T>> products;

  const Vector3<T>& point(Side side) const { return vectors[to_index(shared(side, kPoint))].s; }
  /// The number of rows.
  int size() const { return (coincident ? 3 : 0) + static_cast<int>(products.size()); }

  // What rows are made of. x, y, z are the joint axes of each body (k is 0 to 2), d runs from the joint point of i to that of j.

  PairVector<T> axis(Side side, int k) const {
    return PairVector<T>::direction(side, vectors[to_index(shared(side, k))].s, shared(side, k));
  }
  PairVector<T> displacement() const {
    return PairVector<T>::displacement(point(Side::kI), point(Side::kJ), shared(Side::kI, kPoint), shared(Side::kJ, kPoint));
  }
  /// Adds the row scale (X . Y - offset).
  void add(const PairVector<T>& X, const PairVector<T>& Y, const T& offset = T(0.0), double scale = 1.0) {
    products.push_back({X, Y, offset, scale});
  }
  /// Adds the row k_i . d: the point of j stays in a plane of i.
  void keep_in_plane(int k) { add(axis(Side::kI, k), displacement()); }
  /// Adds the rows x_i . z_j and y_i . z_j: the axes stay parallel.
  void keep_parallel() {
    for (int k : {0, 1}) add(axis(Side::kI, k), axis(Side::kJ, 2));
  }
  /// Adds the row y_i . x_j: no turn about the axis.
  void keep_from_turning() { add(axis(Side::kI, 1), axis(Side::kJ, 0)); }
};

/// The constraint rows of a pair; the table in theory (6) lists them. @param result overwritten, its memory is used again.
template <class T>
void pair_rows(PairKind kind, const PairConstants<T>& c, PairRows<T>* result) {
  PairRows<T>& rows = *result;
  rows.used = {};
  rows.products.clear();
  for (Side side : {Side::kI, Side::kJ})
    for (int k = 0; k < 4; ++k) {
      const Matrix3<T>& C = side == Side::kI ? c.C_i : c.C_j;
      const Vector3<T> s = k < 3 ? Vector3<T>(C.col(k)) : side == Side::kI ? c.s_i : c.s_j;
      const int index = PairRows<T>::shared(side, k);
      rows.vectors[to_index(index)] = {side, k == PairRows<T>::kPoint, 1.0, s, index};
    }
  rows.coincident = kind->force == ForceRows::kAll;
  if (kind->add_rows) kind->add_rows.template of<T>(c, result);
  for (const ProductRow<T>& row : rows.products)
    for (const PairVector<T>* x : {&row.X, &row.Y})
      for (int k = 0; k < x->terms; ++k) rows.used[to_index(x->term[k].shared)] = true;
}
template <class T>
PairRows<T> pair_rows(PairKind kind, const PairConstants<T>& c) {
  PairRows<T> rows;
  pair_rows(kind, c, &rows);
  return rows;
}

}  // namespace codesign
