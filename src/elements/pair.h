// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_ELEMENTS_PAIR_H_
#define MECHANISM_CODESIGN_ELEMENTS_PAIR_H_

#include <cassert>

#include "elements/state_view.h"
#include "elements/workspace.h"
#include "joints/pair_motion.h"
#include "math/span.h"

namespace codesign {

// The constraint rows of one pair, theory (5), (6), and the loads of their multipliers on the two bodies, theory (7).

namespace internal {

/// The derivatives of the three rows of coincident points, Phi = (r_j + A_j s_j) - (r_i + A_i s_i), theory (5), by the coordinates of one
/// of the two bodies. @param sign -1 for body i, +1 for body j. @param row the first of the three rows.
template <class T, class Sink>
void assemble_coincidence(const BodyKinematics<T>& body, const Vector3<T>& s, double sign, int body_column, int row, Sink* sink) {
  const VectorJacobian<T> J = vector_jacobian<T>(body, sign * s);
  for (int l = 0; l < 3; ++l) {
    sink->rate(row + l, body_column + l, T(sign));
    sink->rate(body_column + l, row + l, T(sign));
    for (int c = 0; c < 4; ++c) {
      const int p = body_column + 3 + c;
      sink->position(row + l, p, J.Bdd(l, c));
      sink->velocity(row + l, p, T(2.0 * J.Bd(l, c)));
      sink->rate(row + l, p, J.B(l, c));
      sink->rate(p, row + l, J.B(l, c));
    }
  }
}

/// Whether a product depends on r of the bodies: only if one of its vectors is the displacement d.
template <class T>
bool moves_r(const ProductRow<T>& row) {
  return row.X.terms == 2 || row.Y.terms == 2;
}

/// Whether one of a product's vectors belongs to this side; a displacement belongs to both sides.
template <class T>
bool touches(const ProductRow<T>& row, Side side) {
  const auto touched = [side](const PairVector<T>& x) { return x.terms == 2 || x.term[0].side == side; };
  return touched(row.X) || touched(row.Y);
}

/// Gradients of one product row and its time derivatives, theory (6), by the coordinates of the sides that it touches; other entries of `g`
/// are not set. @param x, y motions of the row's two vectors. @param fixed per side, whether it is the ground.
template <class T>
void row_gradient(const ProductRow<T>& row, const PairMotion<T>& shared, const VectorMotion<T>& x, const VectorMotion<T>& y,
                  const bool (&fixed)[2], ProductGradient<T>* g) {
  for (Side side : {Side::kI, Side::kJ}) {
    if (fixed[static_cast<int>(side)] || !touches(row, side)) continue;
    for (LocalRow<T>* part : {&g->phi_q, &g->phid_q, &g->phidd_q}) {
      if (moves_r(row)) part->template segment<3>(r_offset(side)).setZero();
      part->template segment<4>(p_offset(side)).setZero();
    }
  }
  const auto add = [&](const PairVector<T>& own, const VectorMotion<T>& partner) {
    for (int k = 0; k < own.terms; ++k)
      if (!fixed[static_cast<int>(own.term[k].side)]) add_term_gradient(own.term[k], shared.jacobian_of(own.term[k]), partner, g);
  };
  add(row.X, y);
  add(row.Y, x);
}

}  // namespace internal

/// Sets the pair's rows to Phi'' - epsilon lambda, theory (6), (23), and adds the loads Phi_q^T lambda, theory (7), to Workspace::loads.
/// Must be called before body_residual() and after Workspace::clear_loads().
template <class T>
void pair_residual(const StateView<T>& view, Workspace<T>* workspace, std::size_t k, VectorX<T>* G) {
  const Pair& pair = view.system.topology().pairs[k];
  const PairRows<T>& rows = view.design.rows[k];
  const BodyKinematics<T>&i = view.body(pair.body_i), &j = view.body(pair.body_j);
  BodyLoad<T>*load_i = workspace->load_on(pair.body_i), *load_j = workspace->load_on(pair.body_j);
  int row = view.layout.lambda_column(view.layout.pair_row[k]);
  if (rows.coincident) {
    const Vector3<T>&s_i = rows.point(Side::kI), &s_j = rows.point(Side::kJ);
    G->template segment<3>(row).setZero();
    if (load_j) G->template segment<3>(row) = j.rdd + j.Add * s_j;
    if (load_i) G->template segment<3>(row) -= i.rdd + i.Add * s_i;
    const Vector3<T> lambda = view.state->z.template segment<3>(row);
    add_vector_load(PairVector<T>::displacement(s_i, s_j), lambda, load_i, load_j);
    row += 3;
  }
  PairMotion<T> shared;
  shared.update(rows, i, j, false);
  for (const ProductRow<T>& product : rows.products) {
    const VectorMotion<T>&x = shared.of(product.X), &y = shared.of(product.Y);
    const double scale = product.scale;
    (*G)[row] = scale * product_motion(x, y).phidd;
    add_product_load(product.X, product.Y, x, y, T(scale * view.state->z[row]), load_i, load_j);
    ++row;
  }
  if (view.system.compliance() == 0.0) return;
  const int first = view.layout.lambda_column(view.layout.pair_row[k]);
  G->segment(first, rows.size()) -= T(view.system.compliance()) * view.state->z.segment(first, rows.size());
}

/// Constraint values Phi and rates Phi_q v of one pair's rows, for bodies that move as given; the ground is a body at rest.
/// @param errors, rates one value per row of the pair.
template <class T>
void pair_errors(const StateView<T>& view, int pair, const BodyKinematics<T>& i, const BodyKinematics<T>& j, Out<T> errors, Out<T> rates) {
  const PairRows<T>& rows = view.design.rows[static_cast<std::size_t>(pair)];
  assert(errors.size() == rows.size() && rates.size() == rows.size());
  T *error = errors.data(), *rate = rates.data();
  if (rows.coincident) {
    const VectorMotion<T> d = displacement_motion(i, rows.point(Side::kI), j, rows.point(Side::kJ));
    for (int k = 0; k < 3; ++k) {
      *error++ = d.x[k];
      *rate++ = d.xd[k];
    }
  }
  for (const ProductRow<T>& product : rows.products) {
    const ProductMotion<T> phi = product_motion(motion_of(product.X, i, j), motion_of(product.Y, i, j));
    *error++ = product.scale * (phi.phi - product.offset);
    *rate++ = product.scale * phi.phid;
  }
}

/// Adds the derivatives of one product row and of its multiplier's load, and that load to Workspace::loads. The part K(W) of the load's
/// derivative is left to assemble_body(), once for all rows of a body. @param row of the residual.
template <class T, class Sink>
void assemble_product(const StateView<T>& view, Workspace<T>* workspace, int index, const ProductRow<T>& product,
                      const PairMotion<T>& shared, int row, Sink* sink) {
  const Pair& pair = view.system.topology().pairs[static_cast<std::size_t>(index)];
  const bool fixed[2] = {pair.body_i < 0, pair.body_j < 0};
  const VectorMotion<T>&x = shared.of(product.X), &y = shared.of(product.Y);
  ProductGradient<T> g;
  internal::row_gradient(product, shared, x, y, fixed, &g);
  const double scale = product.scale, twice = 2.0 * product.scale;
  const T lambda = scale * view.state->z[row];
  add_product_load(product.X, product.Y, x, y, lambda, workspace->load_on(pair.body_i), workspace->load_on(pair.body_j));
  for (int local = 0; local < kLocalSize; ++local) {
    const Side side = local < kBodySize ? Side::kI : Side::kJ;
    const int c = view.column(index, local);
    if (c < 0 || !internal::touches(product, side) || (local % kBodySize < 3 && !internal::moves_r(product))) continue;
    const T phi_q = scale * g.phi_q[local];
    sink->position(row, c, T(scale * g.phidd_q[local]));
    sink->velocity(row, c, T(twice * g.phid_q[local]));
    sink->rate(row, c, phi_q);
    sink->rate(c, row, phi_q);
  }
  const auto add = [&](int r, int c, const T& value) { sink->position(view.column(index, r), view.column(index, c), value); };
  for (int k = 0; k < product.X.terms; ++k)
    for (int l = 0; l < product.Y.terms; ++l) {
      const VectorTerm<T>&a = product.X.term[k], &b = product.Y.term[l];
      if (fixed[static_cast<int>(a.side)] || fixed[static_cast<int>(b.side)]) continue;
      term_hessian<T>(a, shared.jacobian_of(a).B, b, shared.jacobian_of(b).B, lambda * (a.sign * b.sign), add);
    }
}

/// Adds the derivatives of pair_residual(), and the loads of the multipliers to Workspace::loads. Must be called before assemble_body().
template <class T, class Sink>
void assemble_pair(const StateView<T>& view, Workspace<T>* workspace, std::size_t k, Sink* sink) {
  const Pair& pair = view.system.topology().pairs[k];
  const PairRows<T>& rows = view.design.rows[k];
  const BodyKinematics<T>&i = view.body(pair.body_i), &j = view.body(pair.body_j);
  int row = view.layout.lambda_column(view.layout.pair_row[k]);
  if (rows.coincident) {
    const Vector3<T> lambda = view.state->z.template segment<3>(row);
    add_vector_load(PairVector<T>::displacement(rows.point(Side::kI), rows.point(Side::kJ)), lambda, workspace->load_on(pair.body_i),
                    workspace->load_on(pair.body_j));
    if (pair.body_i >= 0) internal::assemble_coincidence(i, rows.point(Side::kI), -1.0, kBodySize * pair.body_i, row, sink);
    if (pair.body_j >= 0) internal::assemble_coincidence(j, rows.point(Side::kJ), 1.0, kBodySize * pair.body_j, row, sink);
    row += 3;
  }
  PairMotion<T> shared;
  shared.update(rows, i, j, true);
  for (const ProductRow<T>& product : rows.products) assemble_product(view, workspace, static_cast<int>(k), product, shared, row++, sink);
  if (view.system.compliance() == 0.0) return;
  for (int r = row - rows.size(); r < row; ++r) sink->rate(r, r, T(-view.system.compliance()));
}

}  // namespace codesign

#endif  // MECHANISM_CODESIGN_ELEMENTS_PAIR_H_
