// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_JOINTS_COORDINATE_LOAD_H_
#define MECHANISM_CODESIGN_JOINTS_COORDINATE_LOAD_H_

#include <cmath>

#include "joints/coordinate.h"

namespace codesign {

// The derivative by positions of the generalized forces J^T L of a load along a coordinate, (J^T L)_q = L theta_qq; doc/theory.md (8). Rows
// and columns belong to the pair's 14 coordinates.

namespace internal {

/// Calls add(row, column, value) for the entries of weight * (X . Y)_qq.
template <class T, class Add>
void add_product_curvature(const PairVector<T>& X, const PairVector<T>& Y, const T& weight, const BodyKinematics<T>& i,
                           const BodyKinematics<T>& j, const Add& add) {
  product_hessian(X, Y, weight, i, j, add);
  BodyLoad<T> load_i, load_j;
  add_product_load(X, Y, motion_of(X, i, j), motion_of(Y, i, j), weight, &load_i, &load_j);
  const auto add_turning = [&](Side side, const Matrix3<T>& W) {
    const Matrix4<T> K = rotation_hessian(W);
    for (int row = 0; row < 4; ++row)
      for (int column = 0; column < 4; ++column) add(p_offset(side) + row, p_offset(side) + column, K(row, column));
  };
  add_turning(Side::kI, load_i.W);
  add_turning(Side::kJ, load_j.W);
}

/// Calls add(row, column, value) for the entries of weight * (a b^T + b a^T)/2 that belong to Euler parameters.
template <class T, class Add>
void add_outer_product(const LocalRow<T>& a, const LocalRow<T>& b, const T& weight, const Add& add) {
  const T half = 0.5 * weight;
  for (int row = 0; row < kLocalSize; ++row)
    for (int column = 0; column < kLocalSize; ++column)
      if (row % kBodySize >= 3 && column % kBodySize >= 3) add(row, column, T(half * (a[row] * b[column] + b[row] * a[column])));
}

/// Calls add(row, column, value) for the entries of load * theta_qq with theta = atan2(N, D) or asin(N), by the chain rule.
template <class T, class Add>
void add_angle_curvature(const CoordinateConstants<T>& c, const BodyKinematics<T>& i, const BodyKinematics<T>& j, const T& load,
                         const Add& add) {
  using std::sqrt;
  const PairVector<T> a = PairVector<T>::direction(Side::kI, c.a), b = PairVector<T>::direction(Side::kJ, c.b);
  const Product<T> N = product(a, b, i, j);
  const T n = N.motion.phi;
  if (c.kind == CoordinateConstants<T>::Kind::kSine) {
    const T square = 1.0 - n * n, slope = 1.0 / sqrt(square);
    add_product_curvature(a, b, T(load * slope), i, j, add);
    add_outer_product(N.gradient.phi_q, N.gradient.phi_q, T(load * slope * n / square), add);
    return;
  }
  const PairVector<T> e = PairVector<T>::direction(Side::kI, c.c), f = PairVector<T>::direction(Side::kJ, c.d);
  const Product<T> D = product(e, f, i, j);
  const T d = D.motion.phi, square = n * n + d * d, weight = load / square, curvature = weight / square;
  add_product_curvature(a, b, T(weight * d), i, j, add);
  add_product_curvature(e, f, T(-weight * n), i, j, add);
  add_outer_product(N.gradient.phi_q, N.gradient.phi_q, T(T(-2.0) * curvature * n * d), add);
  add_outer_product(D.gradient.phi_q, D.gradient.phi_q, T(2.0 * curvature * n * d), add);
  add_outer_product(N.gradient.phi_q, D.gradient.phi_q, T(2.0 * curvature * (n * n - d * d)), add);
}

}  // namespace internal

/// Calls add(row, column, value) for the entries of (J^T load)_q at constant load. @param load opposes the coordinate [N m or N].
template <class T, class Add>
void coordinate_load_gradient(const PairConstants<T>& pair, const CoordinateConstants<T>& c, const BodyKinematics<T>& i,
                              const BodyKinematics<T>& j, const T& load, const Add& add) {
  using Kind = typename CoordinateConstants<T>::Kind;
  const T signed_load = T(c.sign) * load;
  const auto add_block = [&add](Side side, const Matrix4<T>& block) {
    for (int row = 0; row < 4; ++row)
      for (int column = 0; column < 4; ++column) add(p_offset(side) + row, p_offset(side) + column, block(row, column));
  };
  const T twice = 2.0 * signed_load;
  switch (c.kind) {
    case Kind::kTurn:
      add_block(Side::kJ, body_rate_hessian<T>(twice * pair.C_j.col(2)));
      add_block(Side::kI, body_rate_hessian<T>(-twice * pair.C_i.col(2)));
      return;
    case Kind::kSpin:
      add_block(Side::kJ, ground_rate_hessian<T>(twice * c.a));
      add_block(Side::kI, ground_rate_hessian<T>(-twice * c.a));
      return;
    case Kind::kSlide:
      internal::add_product_curvature(slide_axis(c), PairVector<T>::displacement(pair.s_i, pair.s_j), signed_load, i, j, add);
      return;
    case Kind::kAngle:
    case Kind::kSine:
      internal::add_angle_curvature(c, i, j, signed_load, add);
      return;
    case Kind::kNone:
      return;
  }
}

}  // namespace codesign

#endif  // MECHANISM_CODESIGN_JOINTS_COORDINATE_LOAD_H_
