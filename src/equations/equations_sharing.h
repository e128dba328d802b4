// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_EQUATIONS_EQUATIONS_SHARING_H_
#define MECHANISM_CODESIGN_EQUATIONS_EQUATIONS_SHARING_H_

#include "equations/equations_assembly.h"

namespace codesign {

// How redundant rows share reactions, theory (23). The displacements w enter where accelerations do, of bodies without velocity: a row's
// acceleration is then Phi_q w, with derivatives that are there already.

// The loads eta are counted in units of 1 / kLoadUnit, so that the equation of w reads kLoadUnit w + Phi_q^T eta = 0. With a unit of one,
// elimination would form Phi_q Phi_q^T, which squares the condition number: of small mechanisms, and near singular positions, no digit of
// the loads is left. A factor as small as the least singular values of Phi_q makes the factorization begin with Phi_q itself.
constexpr double kLoadUnit = 1e-4;

template <class T>
T Equations<T>::dropped(int row) const {
  return T(turn_references_.back()[static_cast<std::size_t>(system_.sharing_layout().miss_slot[static_cast<std::size_t>(row)])]);
}

template <class T>
void Equations<T>::load_sharing() {
  for (int b : system_.sharing_layout().bodies) {
    const BodyKinematics<T>& from = kinematics_[static_cast<std::size_t>(b)];
    BodyKinematics<T>& k = displaced_[static_cast<std::size_t>(b)];
    const int w = system_.sharing_layout().displacement(b);
    k.r = from.r;
    k.p = from.p;
    k.A = from.A;
    k.rdd = state_->z.template segment<3>(w);
    k.pdd = state_->z.template segment<4>(w + 3);
    k.Add = rotation_derivative(k.p, k.pdd);
    shared_loads_[static_cast<std::size_t>(b)].force.setZero();
    shared_loads_[static_cast<std::size_t>(b)].W.setZero();
  }
}

template <class T>
void Equations<T>::share_row(int row, const T& given, VectorX<T>* G) const {
  const SharingLayout& at = system_.sharing_layout();
  const int lambda = layout_.lambda_column(row), eta = at.load(row);
  const T apart = given - state_->z[lambda];
  (*G)[eta] = apart;
  if (!at.has_miss(row)) return;
  const int mu = at.miss(row);
  const T drop = dropped(row), hold = T(1.0) - drop;
  (*G)[lambda] -= state_->z[mu];
  (*G)[eta] = hold * apart + drop * state_->z[eta];
  (*G)[mu] = hold * state_->z[mu] - drop * apart;
}

template <class T>
void Equations<T>::share_pair(int index, VectorX<T>* G) {
  const Pair& pair = system_.topology().pairs[static_cast<std::size_t>(index)];
  const PairRows<T>& rows = rows_[static_cast<std::size_t>(index)];
  const BodyKinematics<T>&i = displaced(pair.body_i), &j = displaced(pair.body_j);
  BodyLoad<T>*load_i = shared_load_on(pair.body_i), *load_j = shared_load_on(pair.body_j);
  int row = layout_.pair_row[static_cast<std::size_t>(index)];
  if (rows.coincident) {
    const Vector3<T>&s_i = rows.point(Side::kI), &s_j = rows.point(Side::kJ);
    Vector3<T> given = Vector3<T>::Zero();
    if (load_j) given = j.rdd + j.Add * s_j;
    if (load_i) given -= i.rdd + i.Add * s_i;
    const Vector3<T> eta = state_->z.template segment<3>(system_.sharing_layout().load(row));
    add_vector_load(PairVector<T>::displacement(s_i, s_j), eta, load_i, load_j);
    for (int k = 0; k < 3; ++k) share_row(row++, given[k], G);
  }
  PairMotion<T> shared;
  shared.update(rows, i, j, false);
  for (const ProductRow<T>& product : rows.products) {
    const VectorMotion<T>&x = shared.of(product.X), &y = shared.of(product.Y);
    const T eta = product.scale * state_->z[system_.sharing_layout().load(row)];
    add_product_load(product.X, product.Y, x, y, eta, load_i, load_j);
    share_row(row++, T(product.scale * product_motion(x, y).phidd), G);
  }
}

template <class T>
void Equations<T>::share_coupling(int index, VectorX<T>* G) {
  const auto k = static_cast<std::size_t>(index);
  const SharingLayout& at = system_.sharing_layout();
  const int row = layout_.coupling_row(index);
  const T eta = state_->z[at.load(row)];
  T given(0.0);
  for (std::size_t t = 0; t < system_.topology().couplings[k].terms.size(); ++t) {
    const CouplingTerm& term = system_.topology().couplings[k].terms[t];
    const Pair& pair = system_.topology().pairs[static_cast<std::size_t>(term.pair)];
    const T c = constants_.couplings[k].coefficients[t];
    const CoordinateMotion<T> motion =
        coordinate_motion(constants_.pairs[static_cast<std::size_t>(term.pair)], coordinate_constants(term.pair, term.element),
                          displaced(pair.body_i), displaced(pair.body_j), CoordinateDetail::kGradient);
    given += c * motion.acceleration;
    for (int local = 0; local < kLocalSize; ++local) {
      const int body = local < kBodySize ? pair.body_i : pair.body_j;
      if (body >= 0) (*G)[at.displacement(body) + local % kBodySize] += motion.J[local] * c * eta;
    }
  }
  share_row(row, given, G);
}

template <class T>
void Equations<T>::sharing_residual(VectorX<T>* G) {
  const SharingLayout& at = system_.sharing_layout();
  load_sharing();
  for (int k : system_.sharing().pairs) share_pair(k, G);
  for (int k : system_.sharing().couplings) share_coupling(k, G);
  for (int b : at.bodies) {
    const BodyKinematics<T>& k = displaced(b);
    const BodyLoad<T>& load = shared_loads_[static_cast<std::size_t>(b)];
    const int w = at.displacement(b), norm = at.load(layout_.norm_row(b));
    G->template segment<3>(w) += kLoadUnit * k.rdd + load.force;
    G->template segment<4>(w + 3) += kLoadUnit * k.pdd + rotation_hessian_product(load.W, k.p) + state_->z[norm] * k.p;
    T sum(0.0);
    for (int e = 0; e < 4; ++e) sum += k.p[e] * k.pdd[e];
    (*G)[norm] = sum;
  }
}

template <class T>
template <class Sink>
void Equations<T>::assemble_given(int row, int body, int local, const T& by_q, const T& by_w, bool moves_q, Sink* sink) const {
  if (body < 0) return;
  const SharingLayout& at = system_.sharing_layout();
  const int q = kBodySize * body + local, w = at.displacement(body) + local, eta = at.load(row);
  sink->rate(w, eta, by_w);
  if (!at.has_miss(row)) {
    sink->rate(eta, w, by_w);
    if (moves_q) sink->position(eta, q, by_q);
    return;
  }
  const T drop = dropped(row), hold = T(1.0) - drop;
  const int mu = at.miss(row);
  sink->rate(eta, w, T(hold * by_w));
  sink->rate(mu, w, T(-(drop * by_w)));
  if (!moves_q) return;
  sink->position(eta, q, T(hold * by_q));
  sink->position(mu, q, T(-(drop * by_q)));
}

template <class T>
template <class Sink>
void Equations<T>::assemble_shared_row(int row, Sink* sink) const {
  const SharingLayout& at = system_.sharing_layout();
  const int lambda = layout_.lambda_column(row), eta = at.load(row);
  if (!at.has_miss(row)) {
    sink->rate(eta, lambda, T(-1.0));
    return;
  }
  const int mu = at.miss(row);
  const T drop = dropped(row), hold = T(1.0) - drop;
  sink->rate(lambda, mu, T(-1.0));
  sink->rate(eta, lambda, T(-hold));
  sink->rate(eta, eta, drop);
  sink->rate(mu, mu, hold);
  sink->rate(mu, lambda, drop);
}

template <class T>
template <class Sink>
void Equations<T>::assemble_shared_products(int index, Sink* sink) {
  const Pair& pair = system_.topology().pairs[static_cast<std::size_t>(index)];
  const PairRows<T>& rows = rows_[static_cast<std::size_t>(index)];
  const SharingLayout& at = system_.sharing_layout();
  const bool fixed[2] = {pair.body_i < 0, pair.body_j < 0};
  int row = layout_.pair_row[static_cast<std::size_t>(index)] + (rows.coincident ? 3 : 0);
  PairMotion<T> shared;
  shared.update(rows, displaced(pair.body_i), displaced(pair.body_j), true);
  for (const ProductRow<T>& product : rows.products) {
    const VectorMotion<T>&x = shared.of(product.X), &y = shared.of(product.Y);
    ProductGradient<T> g;
    internal::row_gradient(product, shared, x, y, fixed, &g);
    const T eta = product.scale * state_->z[at.load(row)];
    add_product_load(product.X, product.Y, x, y, eta, shared_load_on(pair.body_i), shared_load_on(pair.body_j));
    for (int local = 0; local < kLocalSize; ++local) {
      const Side side = local < kBodySize ? Side::kI : Side::kJ;
      if (!internal::touches(product, side) || (local % kBodySize < 3 && !internal::moves_r(product))) continue;
      const int body = side == Side::kI ? pair.body_i : pair.body_j;
      if (body < 0) continue;
      assemble_given(row, body, local % kBodySize, T(product.scale * g.phidd_q[local]), T(product.scale * g.phi_q[local]), true, sink);
    }
    const auto add = [&](int r, int c, const T& value) {
      const int body = r < kBodySize ? pair.body_i : pair.body_j;
      sink->position(at.displacement(body) + r % kBodySize, column(index, c), value);
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

template <class T>
template <class Sink>
void Equations<T>::assemble_shared_pair(int index, Sink* sink) {
  const Pair& pair = system_.topology().pairs[static_cast<std::size_t>(index)];
  const PairRows<T>& rows = rows_[static_cast<std::size_t>(index)];
  const int first = layout_.pair_row[static_cast<std::size_t>(index)];
  for (int k = 0; k < rows.size(); ++k) assemble_shared_row(first + k, sink);
  if (rows.coincident) {
    const Vector3<T> eta = state_->z.template segment<3>(system_.sharing_layout().load(first));
    add_vector_load(PairVector<T>::displacement(rows.point(Side::kI), rows.point(Side::kJ)), eta, shared_load_on(pair.body_i),
                    shared_load_on(pair.body_j));
    for (Side side : {Side::kI, Side::kJ}) {
      const int body = side == Side::kI ? pair.body_i : pair.body_j;
      if (body < 0) continue;
      const double sign = side == Side::kI ? -1.0 : 1.0;
      const VectorJacobian<T> J = vector_jacobian<T>(displaced(body), sign * rows.point(side));
      for (int l = 0; l < 3; ++l) {
        assemble_given(first + l, body, l, T(0.0), T(sign), false, sink);
        for (int c = 0; c < 4; ++c) assemble_given(first + l, body, 3 + c, J.Bdd(l, c), J.B(l, c), true, sink);
      }
    }
  }
  assemble_shared_products(index, sink);
}

template <class T>
template <class Sink>
void Equations<T>::assemble_shared_coupling(int index, Sink* sink) {
  const auto k = static_cast<std::size_t>(index);
  const SharingLayout& at = system_.sharing_layout();
  const int row = layout_.coupling_row(index);
  const T eta = state_->z[at.load(row)];
  assemble_shared_row(row, sink);
  for (std::size_t t = 0; t < system_.topology().couplings[k].terms.size(); ++t) {
    const CouplingTerm& term = system_.topology().couplings[k].terms[t];
    const Pair& pair = system_.topology().pairs[static_cast<std::size_t>(term.pair)];
    const PairConstants<T>& constants = constants_.pairs[static_cast<std::size_t>(term.pair)];
    const CoordinateConstants<T>& coordinate = coordinate_constants(term.pair, term.element);
    const T c = constants_.couplings[k].coefficients[t];
    const bool with_r = coordinate_moves_r(term.pair, term.element);
    const BodyKinematics<T>&i = displaced(pair.body_i), &j = displaced(pair.body_j);
    const CoordinateMotion<T> motion = coordinate_motion(constants, coordinate, i, j, CoordinateDetail::kGradient);
    for (int local = 0; local < kLocalSize; ++local) {
      if (local % kBodySize < 3 && !with_r) continue;
      const int body = local < kBodySize ? pair.body_i : pair.body_j;
      assemble_given(row, body, local % kBodySize, T(c * motion.acceleration_q[local]), T(c * motion.J[local]), true, sink);
    }
    coordinate_load_gradient(constants, coordinate, i, j, T(c * eta), [&](int r, int local_column, const T& entry) {
      const int body = r < kBodySize ? pair.body_i : pair.body_j, q = column(term.pair, local_column);
      if (body >= 0 && q >= 0) sink->position(at.displacement(body) + r % kBodySize, q, entry);
    });
  }
}

template <class T>
template <class Sink>
void Equations<T>::assemble_sharing(Sink* sink) {
  const SharingLayout& at = system_.sharing_layout();
  load_sharing();
  for (int k : system_.sharing().pairs) assemble_shared_pair(k, sink);
  for (int k : system_.sharing().couplings) assemble_shared_coupling(k, sink);
  for (int b : at.bodies) {
    const BodyKinematics<T>& k = displaced(b);
    const int w = at.displacement(b), p = kBodySize * b + 3, norm = at.load(layout_.norm_row(b));
    Matrix4<T> by_p = rotation_hessian(shared_loads_[static_cast<std::size_t>(b)].W);
    for (int e = 0; e < 4; ++e) by_p(e, e) += state_->z[norm];
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

#endif  // MECHANISM_CODESIGN_EQUATIONS_EQUATIONS_SHARING_H_
