// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "math/euler_parameters.h"

namespace codesign {

/// The number of coordinates of a pair of bodies, [r_i, p_i, r_j, p_j], and of one body.
constexpr int kLocalSize = 14;
constexpr int kBodySize = 7;

/// The gradient of a scalar by the coordinates of a pair of bodies, stored as a column. Of a body of the forest, theory (56), the three
/// entries from p_offset() on are the gradient by its angular velocity in its own axes, the fourth is zero.
template <class T>
using LocalRow = Eigen::Matrix<T, kLocalSize, 1>;

/// A body of the pair.
enum class Side { kI = 0, kJ = 1 };

/// The index of the first coordinate of r, and of p, of a body among the pair's coordinates.
constexpr int r_offset(Side side) { return side == Side::kI ? 0 : kBodySize; }
constexpr int p_offset(Side side) { return r_offset(side) + 3; }

/// One term of a vector over a pair: sign * (r + A s) if `point`, else sign * A s.
template <class T>
struct VectorTerm {
  Side side = Side::kI;
  bool point = false;
  double sign = 1.0;
  Vector3<T> s = Vector3<T>::Zero();
  int shared = -1;  ///< index in PairRows::vectors, or -1
};

/// A vector over a pair of bodies, in ground axes: a direction fixed in one of them, or the displacement from a point of i to a point of j.
template <class T>
struct PairVector {
  int terms = 0;
  VectorTerm<T> term[2];

  static PairVector direction(Side side, const Vector3<T>& a, int shared = -1) {
    PairVector x;
    x.terms = 1;
    x.term[0] = {side, false, 1.0, a, shared};
    return x;
  }
  static PairVector displacement(const Vector3<T>& s_i, const Vector3<T>& s_j, int shared_i = -1, int shared_j = -1) {
    PairVector x;
    x.terms = 2;
    x.term[0] = {Side::kJ, true, 1.0, s_j, shared_j};
    x.term[1] = {Side::kI, true, -1.0, s_i, shared_i};
    return x;
  }
};

}  // namespace codesign
