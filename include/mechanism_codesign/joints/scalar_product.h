// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_JOINTS_SCALAR_PRODUCT_H_
#define MECHANISM_CODESIGN_JOINTS_SCALAR_PRODUCT_H_

#include "mechanism_codesign/joints/body_kinematics.h"
#include "mechanism_codesign/joints/local_row.h"

namespace codesign {

// The scalar product phi = X . Y of two vectors over a pair of bodies. Directions normal to each other, a point in a plane, two points at a
// distance: every constraint beside coincident points is one of these; doc/theory.md (6).

template <class T>
VectorMotion<T> motion_of(const PairVector<T>& x, const BodyKinematics<T>& i, const BodyKinematics<T>& j) {
  const VectorTerm<T>& first = x.term[0];
  if (x.terms == 1) return direction_motion(first.side == Side::kI ? i : j, first.s);
  return displacement_motion(i, x.term[1].s, j, first.s);
}

/// phi and its first two time derivatives.
template <class T>
struct ProductMotion {
  T phi, phid, phidd;
};

template <class T>
ProductMotion<T> product_motion(const VectorMotion<T>& x, const VectorMotion<T>& y) {
  return {dot(x.x, y.x), dot(x.xd, y.x) + dot(x.x, y.xd), dot(x.xdd, y.x) + T(2.0) * dot(x.xd, y.xd) + dot(x.x, y.xdd)};
}

/// Gradients over the pair's coordinates: phi_q (= phid_v = phidd_a), phid_q (= phidd_v / 2) and phidd_q.
template <class T>
struct ProductGradient {
  LocalRow<T> phi_q = LocalRow<T>::Zero(), phid_q = LocalRow<T>::Zero(), phidd_q = LocalRow<T>::Zero();
};

namespace internal {

/// Adds the part of the gradient that comes from X's own terms; `y` is the motion of its partner.
template <class T>
void add_product_gradient(const PairVector<T>& x, const VectorMotion<T>& y, const BodyKinematics<T>& i, const BodyKinematics<T>& j,
                          ProductGradient<T>* gradient) {
  for (int k = 0; k < x.terms; ++k) {
    const VectorTerm<T>& term = x.term[k];
    const BodyKinematics<T>& body = term.side == Side::kI ? i : j;
    const T sign(term.sign);
    if (term.point) {
      gradient->phi_q.template segment<3>(r_offset(term.side)) += sign * y.x;
      gradient->phid_q.template segment<3>(r_offset(term.side)) += sign * y.xd;
      gradient->phidd_q.template segment<3>(r_offset(term.side)) += sign * y.xdd;
    }
    const Matrix4<T> K = rotation_hessian<T>(y.x * term.s.transpose()), Kd = rotation_hessian<T>(y.xd * term.s.transpose()),
                     Kdd = rotation_hessian<T>(y.xdd * term.s.transpose());
    const int p = p_offset(term.side);
    gradient->phi_q.template segment<4>(p) += sign * (K * body.p);
    gradient->phid_q.template segment<4>(p) += sign * (K * body.pd + Kd * body.p);
    gradient->phidd_q.template segment<4>(p) += sign * (K * body.pdd + T(2.0) * (Kd * body.pd) + Kdd * body.p);
  }
}

}  // namespace internal

template <class T>
ProductGradient<T> product_gradient(const PairVector<T>& X, const PairVector<T>& Y, const VectorMotion<T>& x, const VectorMotion<T>& y,
                                    const BodyKinematics<T>& i, const BodyKinematics<T>& j) {
  ProductGradient<T> gradient;
  internal::add_product_gradient(X, y, i, j, &gradient);
  internal::add_product_gradient(Y, x, i, j, &gradient);
  return gradient;
}

/// The load of a multiplier on the bodies: phi_q^T lambda = [force on r, K(W) p] with W = sum of b s^T; theory (7).
template <class T>
struct BodyLoad {
  Vector3<T> force = Vector3<T>::Zero();
  Matrix3<T> W = Matrix3<T>::Zero();
};

template <class T>
void add_vector_load(const PairVector<T>& x, const Vector3<T>& b, BodyLoad<T>* i, BodyLoad<T>* j) {
  for (int k = 0; k < x.terms; ++k) {
    const VectorTerm<T>& term = x.term[k];
    BodyLoad<T>* load = term.side == Side::kI ? i : j;
    const Vector3<T> signed_b = T(term.sign) * b;
    if (term.point) load->force += signed_b;
    load->W += signed_b * term.s.transpose();
  }
}

template <class T>
void add_product_load(const PairVector<T>& X, const PairVector<T>& Y, const VectorMotion<T>& x, const VectorMotion<T>& y, const T& lambda, BodyLoad<T>* i,
                      BodyLoad<T>* j) {
  add_vector_load<T>(X, lambda * y.x, i, j);
  add_vector_load<T>(Y, lambda * x.x, i, j);
}

/// Calls add(row, column, value) with the part of (phi_q^T lambda)_q in which both factors move; the remainder is K(W) on each body's p.
template <class T, class Add>
void product_hessian(const PairVector<T>& X, const PairVector<T>& Y, const T& lambda, const BodyKinematics<T>& i, const BodyKinematics<T>& j,
                     const Add& add) {
  for (int k = 0; k < X.terms; ++k) {
    for (int l = 0; l < Y.terms; ++l) {
      const VectorTerm<T>&a = X.term[k], &b = Y.term[l];
      const T weight = lambda * T(a.sign * b.sign);
      const Matrix34<T> Ba = rotated_vector_jacobian(a.side == Side::kI ? i.p : j.p, a.s);
      const Matrix34<T> Bb = rotated_vector_jacobian(b.side == Side::kI ? i.p : j.p, b.s);
      const int ra = r_offset(a.side), pa = p_offset(a.side), rb = r_offset(b.side), pb = p_offset(b.side);
      const auto add_both = [&add](int row, int column, const T& value) {
        add(row, column, value);
        add(column, row, value);
      };
      if (a.point && b.point)
        for (int c = 0; c < 3; ++c) add_both(ra + c, rb + c, weight);
      for (int c = 0; c < 3; ++c) {
        for (int d = 0; d < 4; ++d) {
          if (a.point) add_both(ra + c, pb + d, weight * Bb(c, d));
          if (b.point) add_both(rb + c, pa + d, weight * Ba(c, d));
        }
      }
      const Matrix4<T> cross_term = weight * (Ba.transpose() * Bb);
      for (int c = 0; c < 4; ++c)
        for (int d = 0; d < 4; ++d) add_both(pa + c, pb + d, cross_term(c, d));
    }
  }
}

}  // namespace codesign

#endif  // MECHANISM_CODESIGN_JOINTS_SCALAR_PRODUCT_H_
