// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_ELEMENTS_RIGID_BODY_H_
#define MECHANISM_CODESIGN_ELEMENTS_RIGID_BODY_H_

#include "joints/body_kinematics.h"
#include "mechanism/constants.h"

namespace codesign {

// Inertia of a rigid body in centroidal Euler-parameter coordinates; doc/theory.md (9):
//   rows of r: m r'',   rows of p: 4 G^T J G p'' + 8 G'^T J G p'.

/// Inertia forces of (9), on the left of G: m r'' on the rows of r [N], and 4 G^T J G p'' + 8 G'^T J G p' on the rows of p [N m].
template <class T>
void inertia_force(const BodyConstants<T>& body, const BodyKinematics<T>& k, Vector3<T>* on_r, Vector4<T>* on_p) {
  const Vector3<T> y = 4.0 * (body.J * body_rate(k.p, k.pdd)), w = 8.0 * (body.J * body_rate(k.p, k.pd));
  *on_r = body.mass * k.rdd;
  *on_p = body_rate_transposed(k.p, y) + body_rate_transposed(k.pd, w);
}

/// Derivatives of the rows of p in (9) by p, p' and p''. The rows of r have the derivative m I by r''; their other derivatives are zero.
template <class T>
struct InertiaGradient {
  Matrix4<T> by_p, by_pd, by_pdd;
};

/// The derivatives of inertia_force(); the formulas are given below theory (9).
template <class T>
InertiaGradient<T> inertia_gradient(const BodyConstants<T>& body, const BodyKinematics<T>& k) {
  const Matrix34<T> G = body_rate_matrix(k.p), Gd = body_rate_matrix(k.pd), Gdd = body_rate_matrix(k.pdd);
  const Matrix34<T> JG = 4.0 * (body.J * G), JGd = 8.0 * (body.J * Gd);
  const Vector3<T> y = JG * k.pdd, w = 2.0 * (JG * k.pd);
  InertiaGradient<T> d;
  d.by_pdd = G.transpose() * JG;
  d.by_pd = body_rate_hessian(w) + 2.0 * (Gd.transpose() * JG);
  d.by_p = body_rate_hessian(y) - JG.transpose() * Gdd - Gd.transpose() * JGd;
  return d;
}

}  // namespace codesign

#endif  // MECHANISM_CODESIGN_ELEMENTS_RIGID_BODY_H_
