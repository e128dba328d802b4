// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <vector>

#include "joints/body_kinematics.h"
#include "joints/joint_law.h"
#include "joints/pair_constants.h"
#include "math/arrays.h"
#include "math/euler_parameters.h"

namespace codesign {

/// The number of coordinates of a pair of bodies, [r_i, p_i, r_j, p_j].
constexpr int kLocalSize = 2 * kBodySize;

/// The gradient of a scalar by the coordinates of a pair of bodies, stored as a column. Of a body
/// of the forest, theory (56), the three entries from p_offset() on are the gradient by its angular
/// velocity in its own axes, the fourth is zero.
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

/// A vector over a pair of bodies, in ground axes: a direction fixed in one of them, or the
/// displacement from a point of i to a point of j.
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
  static PairVector displacement(const Vector3<T>& s_i, const Vector3<T>& s_j, int shared_i = -1,
                                 int shared_j = -1) {
    PairVector x;
    x.terms = 2;
    x.term[0] = {Side::kJ, true, 1.0, s_j, shared_j};
    x.term[1] = {Side::kI, true, -1.0, s_i, shared_i};
    return x;
  }
};

// The scalar product phi = X . Y of two vectors over a pair of bodies. All constraints of pairs
// except coincident points have this form: normal directions, a point in a plane, two points at a
// distance; doc/theory.md (6).

/// The motion of a vector over the pair.
template <class T>
VectorMotion<T> motion_of(const PairVector<T>& x, const BodyKinematics<T>& i,
                          const BodyKinematics<T>& j) {
  const VectorTerm<T>& first = x.term[0];
  if (x.terms == 1) return direction_motion(first.side == Side::kI ? i : j, first.s);
  return displacement_motion(i, x.term[1].s, j, first.s);
}

/// phi and its first and second time derivative.
template <class T>
struct ProductMotion {
  T phi, phid, phidd;
};

/// phi = x . y and its time derivatives; theory (6).
template <class T>
ProductMotion<T> product_motion(const VectorMotion<T>& x, const VectorMotion<T>& y) {
  return {dot(x.x, y.x), dot(x.xd, y.x) + dot(x.x, y.xd),
          dot(x.xdd, y.x) + 2.0 * dot(x.xd, y.xd) + dot(x.x, y.xdd)};
}

/// The gradient phi_q of X . Y by the pair's coordinates, which is also that of phi' by velocities.
/// @param x, y the motion of X and Y.
template <class T>
LocalRow<T> product_gradient(const PairVector<T>& X, const PairVector<T>& Y,
                             const VectorMotion<T>& x, const VectorMotion<T>& y,
                             const BodyKinematics<T>& i, const BodyKinematics<T>& j) {
  LocalRow<T> phi_q = LocalRow<T>::Zero();
  const auto add = [&](const PairVector<T>& own, const Vector3<T>& partner) {
    for (int k = 0; k < own.terms; ++k) {
      const VectorTerm<T>& term = own.term[k];
      const BodyKinematics<T>& body = term.side == Side::kI ? i : j;
      if (body.at_rest) continue;
      const double sign = term.sign;
      if (term.point)
        for (int c = 0; c < 3; ++c) phi_q[r_offset(term.side) + c] += sign * partner[c];
      if (body.in_forest) {
        // omega' . (s x A^T y) is the rate of A s along y.
        const Vector3<T> turn = cross<T>(term.s, Vector3<T>(body.A.transpose() * partner));
        for (int c = 0; c < 3; ++c) phi_q[p_offset(term.side) + c] += sign * turn[c];
        continue;
      }
      const Matrix34<T> B = rotated_vector_jacobian(body.p, term.s);
      for (int c = 0; c < 4; ++c)
        phi_q[p_offset(term.side) + c] += sign * dot<T>(B.col(c), partner);
    }
  };
  add(X, y.x);
  add(Y, x.x);
  return phi_q;
}

/// The load of multipliers on one body: (phi_q^T lambda)_b = [force, K(W) p] with W = sum of b s^T;
/// theory (7).
template <class T>
struct BodyLoad {
  Vector3<T> force = Vector3<T>::Zero();  ///< [N], in ground axes
  Matrix3<T> W = Matrix3<T>::Zero();      ///< [N m]
};

/// Adds the load b on every term of x. @param i, j loads of the two bodies; null for the ground.
template <class T>
void add_vector_load(const PairVector<T>& x, const Vector3<T>& b, BodyLoad<T>* i, BodyLoad<T>* j) {
  for (int k = 0; k < x.terms; ++k) {
    const VectorTerm<T>& term = x.term[k];
    BodyLoad<T>* load = term.side == Side::kI ? i : j;
    if (!load) continue;
    const Vector3<T> signed_b = term.sign * b;
    if (term.point) load->force += signed_b;
    load->W += signed_b * term.s.transpose();
  }
}

/// Adds the load phi_q^T lambda of the product phi = X . Y; x and y are the motions of X and Y.
template <class T>
void add_product_load(const PairVector<T>& X, const PairVector<T>& Y, const VectorMotion<T>& x,
                      const VectorMotion<T>& y, const T& lambda, BodyLoad<T>* i, BodyLoad<T>* j) {
  add_vector_load<T>(X, lambda * y.x, i, j);
  add_vector_load<T>(Y, lambda * x.x, i, j);
}

/// The constraint row scale * (X . Y - offset) = 0; theory (6).
template <class T>
struct ProductRow {
  PairVector<T> X, Y;
  T offset{0.0};
  double scale = 1.0;
};

/// The constraint rows of a kinematic pair: if `coincident`, three rows for coincident points, in
/// ground axes; then scalar products; doc/theory.md (5), (6).
///
/// Directions and planes belong to body i, so that the multipliers are components of the paper's
/// F'' and T'' in the joint axes of i, theory (11); the child feels -F'' and -T''. Rows (x_i . d,
/// y_i . d) give F'' = (lambda_1, lambda_2, 0); rows (x_i . z_j, y_i . z_j, y_i . x_j) give T'' =
/// (-lambda_2, lambda_1, lambda_3).
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

  // What rows are made of. x, y, z are the joint axes of each body (k is 0 to 2), d runs from the
  // joint point of i to that of j.

  PairVector<T> axis(Side side, int k) const {
    return PairVector<T>::direction(side, vectors[to_index(shared(side, k))].s, shared(side, k));
  }
  PairVector<T> displacement() const {
    return PairVector<T>::displacement(point(Side::kI), point(Side::kJ), shared(Side::kI, kPoint),
                                       shared(Side::kJ, kPoint));
  }
  /// Adds the row scale (X . Y - offset).
  void add(const PairVector<T>& X, const PairVector<T>& Y, const T& offset = T(0.0),
           double scale = 1.0) {
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

/// The constraint rows of a pair; the table in theory (6) lists them. @param result overwritten,
/// its memory is used again.
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

/// The motion of the vectors that a pair's product rows share (PairRows::vectors), evaluated once
/// for all rows.
template <class T>
struct PairMotion {
  std::array<VectorMotion<T>, PairRows<T>::kVectors> motion;
  VectorMotion<T> displacement;  ///< from the point of i to the point of j

  /// Evaluates the vectors that are used.
  void update(const PairRows<T>& rows, const BodyKinematics<T>& i, const BodyKinematics<T>& j) {
    for (std::size_t k = 0; k < rows.vectors.size(); ++k) {
      if (!rows.used[k]) continue;
      const VectorTerm<T>& term = rows.vectors[k];
      const BodyKinematics<T>& body = term.side == Side::kI ? i : j;
      motion[k] = term.point ? point_motion(body, term.s) : direction_motion(body, term.s);
    }
    constexpr auto from = to_index(PairRows<T>::shared(Side::kI, PairRows<T>::kPoint)),
                   to = to_index(PairRows<T>::shared(Side::kJ, PairRows<T>::kPoint));
    if (rows.used[from])
      displacement = {motion[to].x - motion[from].x, motion[to].xd - motion[from].xd,
                      motion[to].xdd - motion[from].xdd};
  }

  const VectorMotion<T>& of(const VectorTerm<T>& term) const {
    return motion[to_index(term.shared)];
  }

  /// The motion of a direction of the rows, or of the displacement.
  const VectorMotion<T>& of(const PairVector<T>& x) const {
    return x.terms == 1 ? of(x.term[0]) : displacement;
  }
};

}  // namespace codesign
