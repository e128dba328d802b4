// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_SRC_DYNAMICS_EQUATIONS_ASSEMBLY_H_
#define MECHANISM_CODESIGN_SRC_DYNAMICS_EQUATIONS_ASSEMBLY_H_

#include "mechanism_codesign/dynamics/equations.h"
#include "mechanism_codesign/dynamics/rigid_body.h"

namespace codesign {

// The order of the calls of add() must depend on the system only, never on the state: slots are found once (System::record_pattern).

template <class T>
void Equations<T>::linearize(const State<T>& state, Linearization<T>* derivatives) {
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
  for (int b = 0; b < layout_.bodies; ++b) assemble_body(static_cast<std::size_t>(b), sink);
  for (const JointLoad& load : system_.loads()) assemble_load(load, sink);
  assemble_states(sink);
  assemble_objective(sink);
}

namespace internal {

/// Coincident points: Phi = (r_j + A_j s_j) - (r_i + A_i s_i), theory (5); one side's share.
template <class T, class Sink>
void assemble_coincidence(const BodyKinematics<T>& body, const Vector3<T>& s, const T& sign, int body_column, int row, Sink* sink) {
  const T zero(0.0);
  const Matrix34<T> B = rotated_vector_jacobian(body.p, s), Bd = rotated_vector_jacobian(body.pd, s), Bdd = rotated_vector_jacobian(body.pdd, s);
  for (int l = 0; l < 3; ++l) {
    sink->add(row + l, body_column + l, zero, zero, sign);
    sink->add(body_column + l, row + l, zero, zero, sign);
    for (int c = 0; c < 4; ++c) {
      sink->add(row + l, body_column + 3 + c, T(sign * Bdd(l, c)), T(T(2.0) * sign * Bd(l, c)), T(sign * B(l, c)));
      sink->add(body_column + 3 + c, row + l, zero, zero, T(sign * B(l, c)));
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

}  // namespace internal

template <class T>
template <class Sink>
void Equations<T>::assemble_pair(std::size_t k, Sink* sink) {
  const Pair& pair = system_.topology().pairs[k];
  const PairRows<T>& rows = rows_[k];
  const BodyKinematics<T>&i = body(pair.body_i), &j = body(pair.body_j);
  BodyLoad<T>&load_i = loads_[static_cast<std::size_t>(pair.body_i < 0 ? layout_.bodies : pair.body_i)],
  &load_j = loads_[static_cast<std::size_t>(pair.body_j < 0 ? layout_.bodies : pair.body_j)];
  const int index = static_cast<int>(k);
  const T zero(0.0);
  int row = layout_.lambda_column(layout_.pair_row[k]);
  if (rows.coincident) {
    const Vector3<T> lambda = state_->z.template segment<3>(row);
    add_vector_load(PairVector<T>::displacement(rows.s_i, rows.s_j), lambda, &load_i, &load_j);
    if (pair.body_i >= 0) internal::assemble_coincidence(i, rows.s_i, T(-1.0), kBodySize * pair.body_i, row, sink);
    if (pair.body_j >= 0) internal::assemble_coincidence(j, rows.s_j, T(1.0), kBodySize * pair.body_j, row, sink);
    row += 3;
  }
  for (const ProductRow<T>& product : rows.products) {
    const VectorMotion<T> x = motion_of(product.X, i, j), y = motion_of(product.Y, i, j);
    const ProductGradient<T> g = product_gradient(product.X, product.Y, x, y, i, j);
    const T scale(product.scale), lambda = scale * state_->z[row];
    add_product_load(product.X, product.Y, x, y, lambda, &load_i, &load_j);
    for (int local = 0; local < kLocalSize; ++local) {
      const Side side = local < kBodySize ? Side::kI : Side::kJ;
      const int c = column(index, local);
      if (c < 0 || !internal::touches(product, side) || (local % kBodySize < 3 && !internal::moves_r(product))) continue;
      sink->add(row, c, T(scale * g.phidd_q[local]), T(T(2.0) * scale * g.phid_q[local]), T(scale * g.phi_q[local]));
      sink->add(c, row, zero, zero, T(scale * g.phi_q[local]));
    }
    product_hessian(product.X, product.Y, lambda, i, j, [&](int r, int c, const T& value) {
      const int global_row = column(index, r), global_column = column(index, c);
      if (global_row >= 0 && global_column >= 0) sink->add(global_row, global_column, value, zero, zero);
    });
    ++row;
  }
  if (system_.compliance() == 0.0) return;
  for (int r = row - rows.size(); r < row; ++r) sink->add(r, r, zero, zero, T(-system_.compliance()));
}

template <class T>
template <class Sink>
void Equations<T>::assemble_body(std::size_t b, Sink* sink) {
  const BodyKinematics<T>& k = kinematics_[b];
  const int first = kBodySize * static_cast<int>(b), p = first + 3, norm = layout_.lambda_column(layout_.norm_row(static_cast<int>(b)));
  const T zero(0.0);
  const InertiaGradient<T> inertia = inertia_gradient(constants_.bodies[b], k);
  Matrix4<T> by_p = inertia.by_p + rotation_hessian(loads_[b].W);
  for (int e = 0; e < 4; ++e) by_p(e, e) += state_->z[norm];
  for (int e = 0; e < 3; ++e) sink->add(first + e, first + e, zero, zero, constants_.bodies[b].mass);
  for (int row = 0; row < 4; ++row) {
    for (int c = 0; c < 4; ++c) sink->add(p + row, p + c, by_p(row, c), inertia.by_pd(row, c), inertia.by_pdd(row, c));
    sink->add(norm, p + row, k.pdd[row], T(T(2.0) * k.pd[row]), k.p[row]);
    sink->add(p + row, norm, zero, zero, k.p[row]);
  }
}

template <class T>
template <class Sink>
void Equations<T>::assemble_states(Sink* sink) {
  const T zero(0.0);
  for (std::size_t c = 0; c < system_.controllers().size(); ++c) {
    const int s = system_.controllers()[c].state;
    if (s < 0) continue;
    const int row = layout_.state_column(s);
    sink->add(row, row, zero, zero, T(1.0));
    gradient_.clear();
    controller_error(static_cast<int>(c), &gradient_);
    for (const GradientEntry<T>& e : gradient_) sink->add(row, e.column, T(-e.by_position), T(-e.by_velocity), T(-e.by_rate));
  }
}

template <class T>
template <class Sink>
void Equations<T>::assemble_objective(Sink* sink) {
  objective_gradient_.clear();
  objective_terms(system_.integral(), integral_weights_, integral_references_, &objective_gradient_);
  for (const GradientEntry<T>& e : objective_gradient_) sink->add(layout_.columns(), e.column, e.by_position, e.by_velocity, e.by_rate);
}

}  // namespace codesign

#endif  // MECHANISM_CODESIGN_SRC_DYNAMICS_EQUATIONS_ASSEMBLY_H_
