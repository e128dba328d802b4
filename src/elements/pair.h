// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cassert>

#include "elements/state_view.h"
#include "elements/workspace.h"
#include "joints/pair_motion.h"
#include "math/span.h"

namespace codesign {

// The constraint rows of one pair, theory (5), (6), and the loads of their multipliers on the two bodies, theory (7).

/// Sets the pair's rows to Phi'' - epsilon lambda, theory (6), (23), and adds the loads Phi_q^T lambda, theory (7), to Workspace::loads.
/// Must be called before body_residual() and after Workspace::clear_loads().
template <class T>
void pair_residual(const StateView<T>& view, Workspace<T>* workspace, std::size_t k, VectorX<T>* G) {
  if (!view.layout.is_cut(static_cast<int>(k))) return;
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
  shared.update(rows, i, j);
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
  const PairRows<T>& rows = view.design.rows[to_index(pair)];
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

}  // namespace codesign
