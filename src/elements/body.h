// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "elements/state_view.h"
#include "elements/workspace.h"

namespace codesign {

// The rows of one free body: inertia, theory (9), gravity, the loads that other elements added to the workspace, theory (7), and the
// constraint row (p^T p - 1)/2 = 0 with its multiplier.

/// Inertia forces of (9), on the left of G: m r'' on the rows of r [N], and 4 G^T J G p'' + 8 G'^T J G p' on the rows of p [N m].
template <class T>
void inertia_force(const BodyConstants<T>& body, const BodyKinematics<T>& k, Vector3<T>* on_r, Vector4<T>* on_p) {
  const Vector3<T> y = 4.0 * (body.J * body_rate(k.p, k.pdd)), w = 8.0 * (body.J * body_rate(k.p, k.pd));
  *on_r = body.mass * k.rdd;
  *on_p = body_rate_transposed(k.p, y) + body_rate_transposed(k.pd, w);
}

/// Adds m (r'' - g) + f to the rows of r [N] and 4 G^T J G p'' + 8 G'^T J G p' + K(W) p + lambda p to the rows of p [N m], theory (7), (9).
/// Does nothing for a body of the forest. Sets the body's norm row to p^T p'' + p'^T p' [1/s^2]. All loads on bodies must be in `workspace`
/// before.
template <class T>
void body_residual(const StateView<T>& view, Workspace<T>* workspace, std::size_t b, VectorX<T>* G) {
  const BodyKinematics<T>& k = view.kinematics[b];
  if (!view.layout.is_free(static_cast<int>(b))) return;
  const int c = view.layout.column(static_cast<int>(b)), norm = view.layout.lambda_column(view.layout.norm_row(static_cast<int>(b)));
  Vector3<T> on_r;
  Vector4<T> on_p;
  inertia_force(view.design.constants.bodies[b], k, &on_r, &on_p);
  G->template segment<3>(c) += on_r - view.design.constants.bodies[b].mass * view.design.gravity + workspace->loads[b].force;
  G->template segment<4>(c + 3) += on_p + rotation_hessian_product(workspace->loads[b].W, k.p) + view.state->z[norm] * k.p;
  T sum(0.0);
  for (int e = 0; e < 4; ++e) sum += k.p[e] * k.pdd[e] + k.pd[e] * k.pd[e];
  (*G)[norm] = sum;
}

/// Sets the row |p| = 1 of Phi to (p^T p - 1)/2 and its rate to p^T p'.
template <class T>
void norm_error(const StateView<T>& view, int b, VectorX<T>* Phi, VectorX<T>* Phi_rate) {
  if (!view.layout.is_free(b)) return;
  const BodyKinematics<T>& k = view.body(b);
  T square(0.0), rate(0.0);
  for (int e = 0; e < 4; ++e) {
    square += k.p[e] * k.p[e];
    rate += k.p[e] * k.pd[e];
  }
  (*Phi)[view.layout.norm_row(b)] = 0.5 * (square - 1.0);
  (*Phi_rate)[view.layout.norm_row(b)] = rate;
}

}  // namespace codesign
