// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "elements/pair.h"
#include "elements/state_view.h"
#include "math/arrays.h"

namespace codesign {

// How redundant constraint rows share the reactions, theory (23), (23b). The unknowns are
// displacements w of the bodies, loads eta of the rows, and one number mu for each row that can be
// dropped. Phi_q w is computed as Phi'' of bodies without velocity whose acceleration is w, so that
// the formulas of the pairs serve here too.

/// The factor 10^-4 of theory (23b): eta is counted in units of 1/kLoadUnit, and the rows of w read
/// kLoadUnit w + Phi_q^T eta = 0. With a factor of one, elimination would form Phi_q Phi_q^T, whose
/// condition number is squared; small mechanisms, and any mechanism near a singular position, would
/// lose all digits of the loads. A factor of the order of the least singular values of Phi_q makes
/// the factorization begin with Phi_q itself.
constexpr double kLoadUnit = 1e-4;

/// 1 if a row is dropped, 0 if it is enforced; a number, since compiled code takes it as an input.
/// The row must have a mu.
template <class T>
T is_dropped(const StateView<T>& view, int row) {
  return T(view.state->turns[to_index(view.layout.drop_slot +
                                      view.system.sharing_layout().miss_slot[to_index(row)])]);
}

/// Sets Workspace::displaced to the bodies' positions with w as acceleration, and
/// Workspace::shared_loads to zero. Must be called before the functions below.
template <class T>
void load_sharing(const StateView<T>& view, Workspace<T>* workspace) {
  for (int b = 0; b < view.layout.bodies; ++b) {
    if (view.layout.is_free(b)) continue;
    BodyKinematics<T>& carrier = workspace->displaced[to_index(b)];
    carrier.r = view.body(b).r;
    carrier.A = view.body(b).A;
  }
  for (int b : view.system.sharing_layout().bodies) {
    const BodyKinematics<T>& from = view.kinematics[to_index(b)];
    BodyKinematics<T>& k = workspace->displaced[to_index(b)];
    const int w = view.system.sharing_layout().displacement(b);
    k.r = from.r;
    k.p = from.p;
    k.A = from.A;
    k.rdd = view.state->z.template segment<3>(w);
    k.pdd = view.state->z.template segment<4>(w + 3);
    k.Add = rotation_derivative(k.p, k.pdd);
    workspace->shared_loads[to_index(b)].force.setZero();
    workspace->shared_loads[to_index(b)].W.setZero();
  }
}

/// Sets the rows of eta and mu of one constraint row, and subtracts mu from the row Phi'' itself,
/// theory (23), (23b). Must be called after pair_residual() or coupling_residual() of that row.
/// @param given its Phi_q w.
template <class T>
void share_row(const StateView<T>& view, int row, const T& given, VectorX<T>* G) {
  const SharingLayout& at = view.system.sharing_layout();
  const int lambda = view.layout.lambda_column(row), eta = at.load(row);
  const T apart = given - view.state->z[lambda];
  (*G)[eta] = apart;
  if (!at.has_miss(row)) return;
  const int mu = at.miss(row);
  const T drop = is_dropped(view, row), hold = T(1.0) - drop;
  (*G)[lambda] -= view.state->z[mu];
  (*G)[eta] = hold * apart + drop * view.state->z[eta];
  (*G)[mu] = hold * view.state->z[mu] - drop * apart;
}

/// share_row() for all rows of a pair; adds the loads Phi_q^T eta to Workspace::shared_loads.
template <class T>
void share_pair(const StateView<T>& view, Workspace<T>* workspace, int index, VectorX<T>* G) {
  const Pair& pair = view.pair(index);
  const PairRows<T>& rows = view.design.rows[to_index(index)];
  const BodyKinematics<T>&i = workspace->displaced_body(pair.body_i),
        &j = workspace->displaced_body(pair.body_j);
  BodyLoad<T>*load_i = workspace->shared_load_on(pair.body_i),
  *load_j = workspace->shared_load_on(pair.body_j);
  int row = view.layout.pair_row[to_index(index)];
  if (rows.coincident) {
    const Vector3<T>&s_i = rows.point(Side::kI), &s_j = rows.point(Side::kJ);
    Vector3<T> given = Vector3<T>::Zero();
    if (load_j) given = j.rdd + j.Add * s_j;
    if (load_i) given -= i.rdd + i.Add * s_i;
    const Vector3<T> eta =
        view.state->z.template segment<3>(view.system.sharing_layout().load(row));
    add_vector_load(PairVector<T>::displacement(s_i, s_j), eta, load_i, load_j);
    for (int k = 0; k < 3; ++k) share_row(view, row++, given[k], G);
  }
  PairMotion<T> shared;
  shared.update(rows, i, j);
  for (const ProductRow<T>& product : rows.products) {
    const VectorMotion<T>&x = shared.of(product.X), &y = shared.of(product.Y);
    const T eta = product.scale * view.state->z[view.system.sharing_layout().load(row)];
    add_product_load(product.X, product.Y, x, y, eta, load_i, load_j);
    share_row(view, row++, T(product.scale * product_motion(x, y).phidd), G);
  }
}

/// share_row() for a coupling; adds its load J_k^T c_k eta to the rows of w.
template <class T>
void share_coupling(const StateView<T>& view, Workspace<T>* workspace, int index, VectorX<T>* G) {
  const auto k = to_index(index);
  const SharingLayout& at = view.system.sharing_layout();
  const int row = view.layout.coupling_row(index);
  const T eta = view.state->z[at.load(row)];
  T given(0.0);
  for (std::size_t t = 0; t < view.system.topology().couplings[k].terms.size(); ++t) {
    const CouplingTerm& term = view.system.topology().couplings[k].terms[t];
    const Pair& pair = view.pair(term.pair);
    const T c = view.design.constants.couplings[k].coefficients[t];
    const CoordinateMotion<T> motion = coordinate_motion(
        view.constants(term.pair), view.coordinate_constants(term.pair, term.element),
        workspace->displaced_body(pair.body_i), workspace->displaced_body(pair.body_j),
        CoordinateDetail::kAcceleration);
    given += c * motion.acceleration;
    for (int local = 0; local < kLocalSize; ++local) {
      const int body = local < kBodySize ? pair.body_i : pair.body_j;
      if (body >= 0) (*G)[at.displacement(body) + local % kBodySize] += motion.J[local] * c * eta;
    }
  }
  share_row(view, row, given, G);
}

/// Sets all rows of shared reactions: of w, eta and mu. Must be called after the pairs and the
/// couplings; only if rows are dropped.
template <class T>
void sharing_residual(const StateView<T>& view, Workspace<T>* workspace, VectorX<T>* G) {
  const SharingLayout& at = view.system.sharing_layout();
  load_sharing(view, workspace);
  for (int k : view.system.sharing().pairs) share_pair(view, workspace, k, G);
  for (int k : view.system.sharing().couplings) share_coupling(view, workspace, k, G);
  for (int b : at.bodies) {
    const BodyKinematics<T>& k = workspace->displaced_body(b);
    const BodyLoad<T>& load = workspace->shared_loads[to_index(b)];
    const int w = at.displacement(b), norm = at.load(view.layout.norm_row(b));
    G->template segment<3>(w) += kLoadUnit * k.rdd + load.force;
    G->template segment<4>(w + 3) +=
        kLoadUnit * k.pdd + rotation_hessian_product(load.W, k.p) + view.state->z[norm] * k.p;
    T sum(0.0);
    for (int e = 0; e < 4; ++e) sum += k.p[e] * k.pdd[e];
    (*G)[norm] = sum;
  }
}

}  // namespace codesign
