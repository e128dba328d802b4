// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_EQUATIONS_EQUATIONS_ASSEMBLY_H_
#define MECHANISM_CODESIGN_EQUATIONS_EQUATIONS_ASSEMBLY_H_

#include "equations/equations.h"
#include "equations/rigid_body.h"

namespace codesign {

// The order of the calls of add() must depend on the system only, never on the state: slots are found once (System::record_pattern).

template <class T>
void Equations<T>::linearize(const State<T>& state, Linearization<T>* derivatives) {
  if (!compiled_.linearize(state, turn_references_, derivatives)) linearize_by_formulas(state, derivatives);
}

template <class T>
void Equations<T>::linearize_by_formulas(const State<T>& state, Linearization<T>* derivatives) {
  load(state);
  AssemblySink<T> sink(system_.slots(), derivatives);
  assemble(&sink);
}

template <class T>
template <class Sink>
void Equations<T>::assemble(Sink* sink) {
  for (BodyLoad<T>& load : loads_) {
    load.force.setZero();
    load.W.setZero();
  }
  for (std::size_t k = 0; k < rows_.size(); ++k) assemble_pair(k, sink);
  for (std::size_t k = 0; k < constants_.springs.size(); ++k) assemble_spring(k, sink);
  for (std::size_t k = 0; k < wrenches_.size(); ++k) add_link_load(k);
  for (int b = 0; b < layout_.bodies; ++b) assemble_body(static_cast<std::size_t>(b), sink);
  for (std::size_t k = 0; k < wrenches_.size(); ++k) assemble_link_load(k, sink);
  for (const Rotor& rotor : system_.rotors()) assemble_rotor(rotor, sink);
  for (std::size_t k = 0; k < constants_.couplings.size(); ++k) assemble_coupling(k, sink);
  for (const JointLoad& load : system_.loads()) assemble_load(load, sink);
  for (int pair : system_.contacts()) assemble_contact(pair, sink);
  for (const BristleContact& contact : system_.bristles()) assemble_bristle(contact, sink);
  assemble_states(sink);
  if (system_.sharing().drops()) assemble_sharing(sink);
  assemble_objective(sink);
}

namespace internal {

/// Coincident points: Phi = (r_j + A_j s_j) - (r_i + A_i s_i), theory (5); one side's share.
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

/// Whether a product depends on r of a side: only through displacements.
template <class T>
bool moves_r(const ProductRow<T>& row) {
  return row.X.terms == 2 || row.Y.terms == 2;
}

template <class T>
bool touches(const ProductRow<T>& row, Side side) {
  const auto touched = [side](const PairVector<T>& x) { return x.terms == 2 || x.term[0].side == side; };
  return touched(row.X) || touched(row.Y);
}

/// Gradients of one product row over those of the pair's coordinates that it touches, from the shared vectors. `fixed` tells which side is
/// the ground.
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

template <class T>
template <class Sink>
void Equations<T>::assemble_pair(std::size_t k, Sink* sink) {
  const Pair& pair = system_.topology().pairs[k];
  const PairRows<T>& rows = rows_[k];
  const BodyKinematics<T>&i = body(pair.body_i), &j = body(pair.body_j);
  int row = layout_.lambda_column(layout_.pair_row[k]);
  if (rows.coincident) {
    const Vector3<T> lambda = state_->z.template segment<3>(row);
    add_vector_load(PairVector<T>::displacement(rows.point(Side::kI), rows.point(Side::kJ)), lambda, load_on(pair.body_i),
                    load_on(pair.body_j));
    if (pair.body_i >= 0) internal::assemble_coincidence(i, rows.point(Side::kI), -1.0, kBodySize * pair.body_i, row, sink);
    if (pair.body_j >= 0) internal::assemble_coincidence(j, rows.point(Side::kJ), 1.0, kBodySize * pair.body_j, row, sink);
    row += 3;
  }
  PairMotion<T> shared;
  shared.update(rows, i, j, true);
  for (const ProductRow<T>& product : rows.products) assemble_product(static_cast<int>(k), product, shared, row++, sink);
  if (system_.compliance() == 0.0) return;
  for (int r = row - rows.size(); r < row; ++r) sink->rate(r, r, T(-system_.compliance()));
}

template <class T>
template <class Sink>
void Equations<T>::assemble_product(int index, const ProductRow<T>& product, const PairMotion<T>& shared, int row, Sink* sink) {
  const Pair& pair = system_.topology().pairs[static_cast<std::size_t>(index)];
  const bool fixed[2] = {pair.body_i < 0, pair.body_j < 0};
  const VectorMotion<T>&x = shared.of(product.X), &y = shared.of(product.Y);
  ProductGradient<T> g;
  internal::row_gradient(product, shared, x, y, fixed, &g);
  const double scale = product.scale, twice = 2.0 * product.scale;
  const T lambda = scale * state_->z[row];
  add_product_load(product.X, product.Y, x, y, lambda, load_on(pair.body_i), load_on(pair.body_j));
  for (int local = 0; local < kLocalSize; ++local) {
    const Side side = local < kBodySize ? Side::kI : Side::kJ;
    const int c = column(index, local);
    if (c < 0 || !internal::touches(product, side) || (local % kBodySize < 3 && !internal::moves_r(product))) continue;
    const T phi_q = scale * g.phi_q[local];
    sink->position(row, c, T(scale * g.phidd_q[local]));
    sink->velocity(row, c, T(twice * g.phid_q[local]));
    sink->rate(row, c, phi_q);
    sink->rate(c, row, phi_q);
  }
  const auto add = [&](int r, int c, const T& value) { sink->position(column(index, r), column(index, c), value); };
  for (int k = 0; k < product.X.terms; ++k)
    for (int l = 0; l < product.Y.terms; ++l) {
      const VectorTerm<T>&a = product.X.term[k], &b = product.Y.term[l];
      if (fixed[static_cast<int>(a.side)] || fixed[static_cast<int>(b.side)]) continue;
      term_hessian<T>(a, shared.jacobian_of(a).B, b, shared.jacobian_of(b).B, lambda * (a.sign * b.sign), add);
    }
}

template <class T>
template <class Sink>
void Equations<T>::assemble_body(std::size_t b, Sink* sink) {
  const BodyKinematics<T>& k = kinematics_[b];
  const int first = kBodySize * static_cast<int>(b), p = first + 3, norm = layout_.lambda_column(layout_.norm_row(static_cast<int>(b)));
  const InertiaGradient<T> inertia = inertia_gradient(constants_.bodies[b], k);
  Matrix4<T> by_p = inertia.by_p + rotation_hessian(loads_[b].W);
  for (int e = 0; e < 4; ++e) by_p(e, e) += state_->z[norm];
  for (int e = 0; e < 3; ++e) sink->rate(first + e, first + e, constants_.bodies[b].mass);
  for (int row = 0; row < 4; ++row) {
    for (int c = 0; c < 4; ++c) {
      sink->position(p + row, p + c, by_p(row, c));
      sink->velocity(p + row, p + c, inertia.by_pd(row, c));
      sink->rate(p + row, p + c, inertia.by_pdd(row, c));
    }
    sink->position(norm, p + row, k.pdd[row]);
    sink->velocity(norm, p + row, T(2.0 * k.pd[row]));
    sink->rate(norm, p + row, k.p[row]);
    sink->rate(p + row, norm, k.p[row]);
  }
}

template <class T>
template <class Sink>
void Equations<T>::assemble_states(Sink* sink) {
  for (std::size_t c = 0; c < system_.controllers().size(); ++c) {
    const int s = system_.controllers()[c].state;
    if (s < 0) continue;
    const int row = layout_.state_column(s);
    sink->rate(row, row, T(1.0));
    gradient_.clear();
    controller_error(static_cast<int>(c), &gradient_);
    add_row(row, T(-1.0), gradient_, sink);
  }
}

template <class T>
template <class Sink>
void Equations<T>::assemble_objective(Sink* sink) {
  objective_gradient_.clear();
  objective_terms(system_.integral(), integral_weights_, integral_references_, &objective_gradient_);
  add_row(layout_.columns(), T(1.0), objective_gradient_, sink);
}

}  // namespace codesign

#endif  // MECHANISM_CODESIGN_EQUATIONS_EQUATIONS_ASSEMBLY_H_
