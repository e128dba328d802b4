// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "joints/body_kinematics.h"
#include "joints/local_row.h"

namespace codesign {

// The scalar product phi = X . Y of two vectors over a pair of bodies. All constraints of pairs except coincident points have this form:
// normal directions, a point in a plane, two points at a distance; doc/theory.md (6).

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

/// The gradient phi_q of X . Y by the pair's coordinates, which is also that of phi' by velocities. @param x, y the motion of X and Y.
template <class T>
LocalRow<T> product_gradient(const PairVector<T>& X, const PairVector<T>& Y, const VectorMotion<T>& x, const VectorMotion<T>& y,
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
      for (int c = 0; c < 4; ++c) phi_q[p_offset(term.side) + c] += sign * dot<T>(B.col(c), partner);
    }
  };
  add(X, y.x);
  add(Y, x.x);
  return phi_q;
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

}  // namespace codesign
