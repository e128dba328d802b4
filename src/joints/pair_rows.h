// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <vector>

#include "joints/scalar_product.h"
#include "mechanism/constants.h"

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

  const Vector3<T>& point(Side side) const { return vectors[static_cast<std::size_t>(shared(side, kPoint))].s; }
  /// The number of rows.
  int size() const { return (coincident ? 3 : 0) + static_cast<int>(products.size()); }
};

namespace internal {

/// Sets PairRows::vectors.
template <class T>
void share_vectors(const PairConstants<T>& c, PairRows<T>* rows) {
  for (Side side : {Side::kI, Side::kJ})
    for (int k = 0; k < 4; ++k) {
      const Matrix3<T>& C = side == Side::kI ? c.C_i : c.C_j;
      const Vector3<T> s = k < 3 ? Vector3<T>(C.col(k)) : side == Side::kI ? c.s_i : c.s_j;
      const int index = PairRows<T>::shared(side, k);
      rows->vectors[static_cast<std::size_t>(index)] = {side, k == PairRows<T>::kPoint, 1.0, s, index};
    }
}

}  // namespace internal

/// The constraint rows of a pair of this kind; the table in theory (6) lists them. @param result overwritten, its memory is used again.
template <class T>
void pair_rows(PairKind kind, const PairConstants<T>& c, PairRows<T>* result) {
  using V = PairVector<T>;
  using R = PairRows<T>;
  R& rows = *result;
  rows.used = {};
  rows.products.clear();
  internal::share_vectors(c, &rows);
  const auto axis = [&](Side side, int k) {
    const int index = R::shared(side, k);
    return V::direction(side, rows.vectors[static_cast<std::size_t>(index)].s, index);
  };
  const auto axis_i = [&](int k) { return axis(Side::kI, k); };
  const auto axis_j = [&](int k) { return axis(Side::kJ, k); };
  const V d = V::displacement(c.s_i, c.s_j, R::shared(Side::kI, R::kPoint), R::shared(Side::kJ, R::kPoint));
  const auto in_plane = [&](int k) { rows.products.push_back({axis_i(k), d, T(0.0), 1.0}); };
  const auto parallel_z = [&] {
    rows.products.push_back({axis_i(0), axis_j(2), T(0.0), 1.0});
    rows.products.push_back({axis_i(1), axis_j(2), T(0.0), 1.0});
  };
  const auto no_turn = [&] { rows.products.push_back({axis_i(1), axis_j(0), T(0.0), 1.0}); };
  rows.coincident = traits_of(kind).force == ForceRows::kAll;
  switch (kind) {
    case PairKind::kFixed:
      parallel_z(), no_turn();
      break;
    case PairKind::kRevolute:
      parallel_z();
      break;
    case PairKind::kPrismatic:
      in_plane(0), in_plane(1), parallel_z(), no_turn();
      break;
    case PairKind::kCylindrical:
      in_plane(0), in_plane(1), parallel_z();
      break;
    case PairKind::kUniversal:
      rows.products.push_back({axis_i(2), axis_j(2), c.cosine, 1.0});
      break;
    case PairKind::kTable:
      in_plane(2), parallel_z(), no_turn();
      break;
    case PairKind::kPlanar:
      in_plane(2), parallel_z();
      break;
    case PairKind::kTranslational:
      parallel_z(), no_turn();
      break;
    case PairKind::kDistance:
      rows.products.push_back({d, d, c.distance * c.distance, 0.5});
      break;
    case PairKind::kSpherical:
    case PairKind::kFree:
      break;
  }
  for (const ProductRow<T>& row : rows.products)
    for (const V* x : {&row.X, &row.Y})
      for (int k = 0; k < x->terms; ++k) rows.used[static_cast<std::size_t>(x->term[k].shared)] = true;
}
template <class T>
PairRows<T> pair_rows(PairKind kind, const PairConstants<T>& c) {
  PairRows<T> rows;
  pair_rows(kind, c, &rows);
  return rows;
}

}  // namespace codesign
