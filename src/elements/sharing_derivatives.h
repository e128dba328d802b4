// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_ELEMENTS_SHARING_DERIVATIVES_H_
#define MECHANISM_CODESIGN_ELEMENTS_SHARING_DERIVATIVES_H_

#include "elements/sharing.h"
#include "joints/coordinate_load.h"

namespace codesign {

// The derivatives of sharing.h by positions and by the unknowns lambda, w, eta and mu; theory (23), (23b).

/// Adds the derivatives of one entry of Phi_q w in the rows of eta and mu, and of Phi_q^T eta in the row of w.
/// @param row of Phi. @param local coordinate of the body, 0 to 6. @param by_q, by_w derivatives of the entry. @param moves_q whether it
/// depends on q at all.
template <class T, class Sink>
void assemble_given(const StateView<T>& view, int row, int body, int local, const T& by_q, const T& by_w, bool moves_q, Sink* sink) {
  if (body < 0) return;
  const SharingLayout& at = view.system.sharing_layout();
  const int q = kBodySize * body + local, w = at.displacement(body) + local, eta = at.load(row);
  sink->rate(w, eta, by_w);
  if (!at.has_miss(row)) {
    sink->rate(eta, w, by_w);
    if (moves_q) sink->position(eta, q, by_q);
    return;
  }
  const T drop = is_dropped(view, row), hold = T(1.0) - drop;
  const int mu = at.miss(row);
  sink->rate(eta, w, T(hold * by_w));
  sink->rate(mu, w, T(-(drop * by_w)));
  if (!moves_q) return;
  sink->position(eta, q, T(hold * by_q));
  sink->position(mu, q, T(-(drop * by_q)));
}

/// Adds the derivatives of share_row() by lambda, eta and mu.
template <class T, class Sink>
void assemble_shared_row(const StateView<T>& view, int row, Sink* sink) {
  const SharingLayout& at = view.system.sharing_layout();
  const int lambda = view.layout.lambda_column(row), eta = at.load(row);
  if (!at.has_miss(row)) {
    sink->rate(eta, lambda, T(-1.0));
    return;
  }
  const int mu = at.miss(row);
  const T drop = is_dropped(view, row), hold = T(1.0) - drop;
  sink->rate(lambda, mu, T(-1.0));
  sink->rate(eta, lambda, T(-hold));
  sink->rate(eta, eta, drop);
  sink->rate(mu, mu, hold);
  sink->rate(mu, lambda, drop);
}

/// Adds the derivatives of the product rows of a pair, and their loads to Workspace::shared_loads.
template <class T, class Sink>
void assemble_shared_products(const StateView<T>& view, Workspace<T>* workspace, int index, Sink* sink) {
  const Pair& pair = view.system.topology().pairs[static_cast<std::size_t>(index)];
  const PairRows<T>& rows = view.design.rows[static_cast<std::size_t>(index)];
  const SharingLayout& at = view.system.sharing_layout();
  const bool fixed[2] = {pair.body_i < 0, pair.body_j < 0};
  int row = view.layout.pair_row[static_cast<std::size_t>(index)] + (rows.coincident ? 3 : 0);
  PairMotion<T> shared;
  shared.update(rows, workspace->displaced_body(pair.body_i), workspace->displaced_body(pair.body_j), true);
  for (const ProductRow<T>& product : rows.products) {
    const VectorMotion<T>&x = shared.of(product.X), &y = shared.of(product.Y);
    ProductGradient<T> g;
    internal::row_gradient(product, shared, x, y, fixed, &g);
    const T eta = product.scale * view.state->z[at.load(row)];
    add_product_load(product.X, product.Y, x, y, eta, workspace->shared_load_on(pair.body_i), workspace->shared_load_on(pair.body_j));
    for (int local = 0; local < kLocalSize; ++local) {
      const Side side = local < kBodySize ? Side::kI : Side::kJ;
      if (!internal::touches(product, side) || (local % kBodySize < 3 && !internal::moves_r(product))) continue;
      const int body = side == Side::kI ? pair.body_i : pair.body_j;
      if (body < 0) continue;
      assemble_given(view, row, body, local % kBodySize, T(product.scale * g.phidd_q[local]), T(product.scale * g.phi_q[local]), true,
                     sink);
    }
    const auto add = [&](int r, int c, const T& value) {
      const int body = r < kBodySize ? pair.body_i : pair.body_j;
      sink->position(at.displacement(body) + r % kBodySize, view.column(index, c), value);
    };
    for (int k = 0; k < product.X.terms; ++k)
      for (int l = 0; l < product.Y.terms; ++l) {
        const VectorTerm<T>&a = product.X.term[k], &b = product.Y.term[l];
        if (fixed[static_cast<int>(a.side)] || fixed[static_cast<int>(b.side)]) continue;
        term_hessian<T>(a, shared.jacobian_of(a).B, b, shared.jacobian_of(b).B, eta * (a.sign * b.sign), add);
      }
    ++row;
  }
}

/// Adds the derivatives of share_pair(), and its loads to Workspace::shared_loads.
template <class T, class Sink>
void assemble_shared_pair(const StateView<T>& view, Workspace<T>* workspace, int index, Sink* sink) {
  const Pair& pair = view.system.topology().pairs[static_cast<std::size_t>(index)];
  const PairRows<T>& rows = view.design.rows[static_cast<std::size_t>(index)];
  const int first = view.layout.pair_row[static_cast<std::size_t>(index)];
  for (int k = 0; k < rows.size(); ++k) assemble_shared_row(view, first + k, sink);
  if (rows.coincident) {
    const Vector3<T> eta = view.state->z.template segment<3>(view.system.sharing_layout().load(first));
    add_vector_load(PairVector<T>::displacement(rows.point(Side::kI), rows.point(Side::kJ)), eta, workspace->shared_load_on(pair.body_i),
                    workspace->shared_load_on(pair.body_j));
    for (Side side : {Side::kI, Side::kJ}) {
      const int body = side == Side::kI ? pair.body_i : pair.body_j;
      if (body < 0) continue;
      const double sign = side == Side::kI ? -1.0 : 1.0;
      const VectorJacobian<T> J = vector_jacobian<T>(workspace->displaced_body(body), sign * rows.point(side));
      for (int l = 0; l < 3; ++l) {
        assemble_given(view, first + l, body, l, T(0.0), T(sign), false, sink);
        for (int c = 0; c < 4; ++c) assemble_given(view, first + l, body, 3 + c, J.Bdd(l, c), J.B(l, c), true, sink);
      }
    }
  }
  assemble_shared_products(view, workspace, index, sink);
}

/// Adds the derivatives of share_coupling().
template <class T, class Sink>
void assemble_shared_coupling(const StateView<T>& view, Workspace<T>* workspace, int index, Sink* sink) {
  const auto k = static_cast<std::size_t>(index);
  const SharingLayout& at = view.system.sharing_layout();
  const int row = view.layout.coupling_row(index);
  const T eta = view.state->z[at.load(row)];
  assemble_shared_row(view, row, sink);
  for (std::size_t t = 0; t < view.system.topology().couplings[k].terms.size(); ++t) {
    const CouplingTerm& term = view.system.topology().couplings[k].terms[t];
    const Pair& pair = view.system.topology().pairs[static_cast<std::size_t>(term.pair)];
    const PairConstants<T>& constants = view.design.constants.pairs[static_cast<std::size_t>(term.pair)];
    const CoordinateConstants<T>& coordinate = view.coordinate_constants(term.pair, term.element);
    const T c = view.design.constants.couplings[k].coefficients[t];
    const bool with_r = view.coordinate_moves_r(term.pair, term.element);
    const BodyKinematics<T>&i = workspace->displaced_body(pair.body_i), &j = workspace->displaced_body(pair.body_j);
    const CoordinateMotion<T> motion = coordinate_motion(constants, coordinate, i, j, CoordinateDetail::kGradient);
    for (int local = 0; local < kLocalSize; ++local) {
      if (local % kBodySize < 3 && !with_r) continue;
      const int body = local < kBodySize ? pair.body_i : pair.body_j;
      assemble_given(view, row, body, local % kBodySize, T(c * motion.acceleration_q[local]), T(c * motion.J[local]), true, sink);
    }
    coordinate_load_gradient(constants, coordinate, i, j, T(c * eta), [&](int r, int local_column, const T& entry) {
      const int body = r < kBodySize ? pair.body_i : pair.body_j, q = view.column(term.pair, local_column);
      if (body >= 0 && q >= 0) sink->position(at.displacement(body) + r % kBodySize, q, entry);
    });
  }
}

/// Adds the derivatives of sharing_residual(); only if rows are dropped.
template <class T, class Sink>
void assemble_sharing(const StateView<T>& view, Workspace<T>* workspace, Sink* sink) {
  const SharingLayout& at = view.system.sharing_layout();
  load_sharing(view, workspace);
  for (int k : view.system.sharing().pairs) assemble_shared_pair(view, workspace, k, sink);
  for (int k : view.system.sharing().couplings) assemble_shared_coupling(view, workspace, k, sink);
  for (int b : at.bodies) {
    const BodyKinematics<T>& k = workspace->displaced_body(b);
    const int w = at.displacement(b), p = kBodySize * b + 3, norm = at.load(view.layout.norm_row(b));
    Matrix4<T> by_p = rotation_hessian(workspace->shared_loads[static_cast<std::size_t>(b)].W);
    for (int e = 0; e < 4; ++e) by_p(e, e) += view.state->z[norm];
    for (int e = 0; e < 7; ++e) sink->rate(w + e, w + e, T(kLoadUnit));
    for (int e = 0; e < 4; ++e) {
      for (int c = 0; c < 4; ++c) sink->position(w + 3 + e, p + c, by_p(e, c));
      sink->position(norm, p + e, k.pdd[e]);
      sink->rate(norm, w + 3 + e, k.p[e]);
      sink->rate(w + 3 + e, norm, k.p[e]);
    }
  }
}

}  // namespace codesign

#endif  // MECHANISM_CODESIGN_ELEMENTS_SHARING_DERIVATIVES_H_
