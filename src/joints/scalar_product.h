// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_JOINTS_SCALAR_PRODUCT_H_
#define MECHANISM_CODESIGN_JOINTS_SCALAR_PRODUCT_H_

#include "joints/body_kinematics.h"
#include "joints/local_row.h"

namespace codesign {

// The scalar product phi = X . Y of two vectors over a pair of bodies. All constraints of pairs except coincident points have this form:
// normal directions, a point in a plane, two points at a distance; doc/theory.md (6). Gradients are by the pair's 14 coordinates.

/// The motion of a vector over the pair.
template <class T>
VectorMotion<T> motion_of(const PairVector<T>& x, const BodyKinematics<T>& i, const BodyKinematics<T>& j) {
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
  return {dot(x.x, y.x), dot(x.xd, y.x) + dot(x.x, y.xd), dot(x.xdd, y.x) + 2.0 * dot(x.xd, y.xd) + dot(x.x, y.xdd)};
}

/// Gradients over the pair's coordinates: phi_q (= phid_v = phidd_a), phid_q (= phidd_v / 2) and phidd_q.
template <class T>
struct ProductGradient {
  LocalRow<T> phi_q, phid_q, phidd_q;

  /// Sets phi_q to zero and, if order > 0, the other two.
  void clear(int order = 2) {
    phi_q.setZero();
    if (order < 1) return;
    phid_q.setZero();
    phidd_q.setZero();
  }
};

/// B(p, s), B(p', s) and B(p'', s) of a body-fixed vector s, from which the Jacobians of A s, (A s)' and (A s)'' by p are made; theory (2).
template <class T>
struct VectorJacobian {
  Matrix34<T> B, Bd, Bdd;
};

/// The Jacobians of the vector s fixed in `body`.
template <class T>
VectorJacobian<T> vector_jacobian(const BodyKinematics<T>& body, const Vector3<T>& s) {
  return {rotated_vector_jacobian(body.p, s), rotated_vector_jacobian(body.pd, s), rotated_vector_jacobian(body.pdd, s)};
}

/// Adds to the gradient of X . Y the part of one term of X. @param J the Jacobians of that term. @param y the motion of Y.
template <class T>
void add_term_gradient(const VectorTerm<T>& term, const VectorJacobian<T>& J, const VectorMotion<T>& y, ProductGradient<T>* gradient) {
  const double sign = term.sign, twice = 2.0 * term.sign;
  if (term.point) {
    const int r = r_offset(term.side);
    for (int c = 0; c < 3; ++c) {
      gradient->phi_q[r + c] += sign * y.x[c];
      gradient->phid_q[r + c] += sign * y.xd[c];
      gradient->phidd_q[r + c] += sign * y.xdd[c];
    }
  }
  const int p = p_offset(term.side);
  for (int c = 0; c < 4; ++c) {
    gradient->phi_q[p + c] += sign * dot<T>(J.B.col(c), y.x);
    gradient->phid_q[p + c] += sign * (dot<T>(J.Bd.col(c), y.x) + dot<T>(J.B.col(c), y.xd));
    gradient->phidd_q[p + c] += sign * (dot<T>(J.Bdd.col(c), y.x) + dot<T>(J.B.col(c), y.xdd)) + twice * dot<T>(J.Bd.col(c), y.xd);
  }
}

/// Likewise for phi_q only. @param B Jacobian of the term by p. @param y the value of Y.
template <class T>
void add_term_slope(const VectorTerm<T>& term, const Matrix34<T>& B, const Vector3<T>& y, LocalRow<T>* phi_q) {
  const double sign = term.sign;
  if (term.point)
    for (int c = 0; c < 3; ++c) (*phi_q)[r_offset(term.side) + c] += sign * y[c];
  for (int c = 0; c < 4; ++c) (*phi_q)[p_offset(term.side) + c] += sign * dot<T>(B.col(c), y);
}

/// The gradient of X . Y. @param x, y the motion of X and Y. @param order 0: phi_q only; 2: all.
template <class T>
ProductGradient<T> product_gradient(const PairVector<T>& X, const PairVector<T>& Y, const VectorMotion<T>& x, const VectorMotion<T>& y,
                                    const BodyKinematics<T>& i, const BodyKinematics<T>& j, int order = 2) {
  ProductGradient<T> gradient;
  gradient.clear(order);
  const auto add = [&](const PairVector<T>& own, const VectorMotion<T>& partner) {
    for (int k = 0; k < own.terms; ++k) {
      const VectorTerm<T>& term = own.term[k];
      const BodyKinematics<T>& body = term.side == Side::kI ? i : j;
      if (body.at_rest) continue;
      if (order == 0) add_term_slope(term, rotated_vector_jacobian(body.p, term.s), partner.x, &gradient.phi_q);
      if (order > 0) add_term_gradient(term, vector_jacobian(body, term.s), partner, &gradient);
    }
  };
  add(X, y);
  add(Y, x);
  return gradient;
}

/// The load of multipliers on one body: (phi_q^T lambda)_b = [force, K(W) p] with W = sum of b s^T; theory (7).
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
void add_product_load(const PairVector<T>& X, const PairVector<T>& Y, const VectorMotion<T>& x, const VectorMotion<T>& y, const T& lambda,
                      BodyLoad<T>* i, BodyLoad<T>* j) {
  add_vector_load<T>(X, lambda * y.x, i, j);
  add_vector_load<T>(Y, lambda * x.x, i, j);
}

/// Calls add(row, column, value) for weight * (D_a^T D_b + D_b^T D_a), the part of (phi_q^T lambda)_q of a pair of terms; theory (6).
/// @param Ba, Bb the Jacobians of the terms by p.
template <class T, class Add>
void term_hessian(const VectorTerm<T>& a, const Matrix34<T>& Ba, const VectorTerm<T>& b, const Matrix34<T>& Bb, const T& weight,
                  const Add& add) {
  const int ra = r_offset(a.side), pa = p_offset(a.side), rb = r_offset(b.side), pb = p_offset(b.side);
  const auto add_both = [&add](int row, int column, const T& value) {
    add(row, column, value);
    add(column, row, value);
  };
  if (a.point && b.point)
    for (int c = 0; c < 3; ++c) add_both(ra + c, rb + c, weight);
  for (int d = 0; d < 4; ++d) {
    for (int c = 0; c < 3; ++c) {
      if (a.point) add_both(ra + c, pb + d, weight * Bb(c, d));
      if (b.point) add_both(rb + c, pa + d, weight * Ba(c, d));
    }
    const Vector3<T> weighted = weight * Bb.col(d);
    for (int c = 0; c < 4; ++c) add_both(pa + c, pb + d, dot<T>(Ba.col(c), weighted));
  }
}

/// Calls add(row, column, value) for the terms D_k^T D_l of (phi_q^T lambda)_q, theory (6); the remainder is K(W) for each body's p.
template <class T, class Add>
void product_hessian(const PairVector<T>& X, const PairVector<T>& Y, const T& lambda, const BodyKinematics<T>& i,
                     const BodyKinematics<T>& j, const Add& add) {
  const auto B = [&](const VectorTerm<T>& term) { return rotated_vector_jacobian(term.side == Side::kI ? i.p : j.p, term.s); };
  for (int k = 0; k < X.terms; ++k)
    for (int l = 0; l < Y.terms; ++l) {
      const VectorTerm<T>&a = X.term[k], &b = Y.term[l];
      term_hessian<T>(a, B(a), b, B(b), lambda * (a.sign * b.sign), add);
    }
}

}  // namespace codesign

#endif  // MECHANISM_CODESIGN_JOINTS_SCALAR_PRODUCT_H_
