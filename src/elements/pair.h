// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cassert>

#include "elements/loads.h"
#include "elements/state_view.h"
#include "joints/pair_rows.h"
#include "math/arrays.h"

namespace codesign {

// The constraint rows of one pair, theory (5), (6), and the loads of their multipliers on the two
// bodies, theory (7).

/// Sets the pair's rows to Phi'' - epsilon lambda, theory (6), (23), and adds the loads Phi_q^T
/// lambda, theory (7), to Workspace::loads. Must be called before body_residual() and after
/// Workspace::clear_loads().
template <class T>
void pair_residual(const StateView<T>& view, Workspace<T>* workspace, std::size_t k,
                   VectorX<T>* G) {
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
  G->segment(first, rows.size()) -=
      T(view.system.compliance()) * view.state->z.segment(first, rows.size());
}

/// Constraint values Phi and rates Phi_q v of one pair's rows, for bodies that move as given; the
/// ground is a body at rest.
/// @param errors, rates one value per row of the pair.
template <class T>
void pair_errors(const StateView<T>& view, int pair, const BodyKinematics<T>& i,
                 const BodyKinematics<T>& j, Out<T> errors, Out<T> rates) {
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
    const ProductMotion<T> phi =
        product_motion(motion_of(product.X, i, j), motion_of(product.Y, i, j));
    *error++ = product.scale * (phi.phi - product.offset);
    *rate++ = product.scale * phi.phid;
  }
}

// Constraint rows between joint coordinates, Phi = sum of c_k theta_k - b, theory (8a), with b a
// function of time for a motion that is given, (8b). The row is linear in the coordinates, so its
// multiplier lambda is a load c_k lambda along each of them.

/// The motion that the study gives to a driven coordinate; at rest in zero for all other couplings.
template <class T>
ReferenceMotion<T> given_motion(const StateView<T>& view, const Coupling& coupling) {
  if (coupling.motion < 0) return {};
  return view.design.motion[to_index(coupling.motion)].at(view.state->t);
}

/// Sets the coupling's entries of Phi and of its rate. Positions count whole turns.
template <class T>
void coupling_error(const StateView<T>& view, std::size_t k, VectorX<T>* Phi,
                    VectorX<T>* Phi_rate) {
  const Coupling& coupling = view.system.topology().couplings[k];
  const CouplingConstants<T>& c = view.design.constants.couplings[k];
  const int row = view.layout.coupling_row(static_cast<int>(k));
  const ReferenceMotion<T> given = given_motion(view, coupling);
  (*Phi)[row] = -c.offset - given.value;
  (*Phi_rate)[row] = -given.rate;
  for (std::size_t t = 0; t < coupling.terms.size(); ++t) {
    const CouplingTerm& term = coupling.terms[t];
    (*Phi)[row] += c.coefficients[t] * view.coordinate_value(term.pair, term.element);
    (*Phi_rate)[row] +=
        c.coefficients[t] * view.coordinate(term.pair, term.element, CoordinateDetail::kRate).rate;
  }
}

/// epsilon of the coupling's row, theory (23). A drive prescribes a motion exactly, theory (28).
template <class T>
double compliance_in(const StateView<T>& view, const Coupling& coupling) {
  return coupling.is_drive ? 0.0 : view.system.compliance();
}

/// Sets the coupling's row to Phi'' - epsilon lambda and adds J_k^T c_k lambda to the rows of
/// motion.
template <class T>
void coupling_residual(const StateView<T>& view, Workspace<T>* workspace, std::size_t k,
                       VectorX<T>* G) {
  const Coupling& coupling = view.system.topology().couplings[k];
  const int row = view.layout.lambda_column(view.layout.coupling_row(static_cast<int>(k)));
  const T lambda = view.state->z[row];
  (*G)[row] =
      T(-compliance_in(view, coupling)) * lambda - given_motion(view, coupling).acceleration;
  for (std::size_t t = 0; t < coupling.terms.size(); ++t) {
    const CouplingTerm& term = coupling.terms[t];
    const T coefficient = view.design.constants.couplings[k].coefficients[t];
    const CoordinateMotion<T>& motion =
        view.coordinate(term.pair, term.element, CoordinateDetail::kAcceleration);
    (*G)[row] += coefficient * motion.acceleration;
    if (const int c = view.layout.element_column(term.pair, term.element); c >= 0)
      (*G)[c] += coefficient * lambda;
    else
      add_load_on_bodies(view, workspace, term.pair, LocalRow<T>(motion.J * coefficient), lambda,
                         G);
  }
}

}  // namespace codesign
