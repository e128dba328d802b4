// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

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

}  // namespace codesign
