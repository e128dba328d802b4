// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "sensitivity/tangent_method.h"

#include "equations/mass_solution.h"
#include "math/arrays.h"
#include "sparse/sparsity.h"

namespace codesign {

// Sets w' in increment i, the derivative of RosenbrockStages::stage_start().
template <int N>
void RosenbrockTangent<N>::stage_start(std::size_t i, double h) {
  const double hg = h * m_.tableau->gamma;
  Directions<N>& u = m_.stages[i];
  RosenbrockTableau::Row factors;
  for (std::size_t j = 0; j < i; ++j) factors[j] = m_.tableau->c[i][j] / h;
  const auto add = [&](const Directions<N>& from, int rate, int first, int size) {
    m_.combine(from.part(rate, size), In<double>(factors).first(to_signed(i)), first,
               u.part(first, size));
  };
  add(m_.stage_y, m_.at.z(), m_.at.v(), m_.at.n);
  add(m_.stage_y, m_.at.v(), m_.at.x(), m_.at.n);
  add(m_.stage_y, m_.at.sigma(), m_.at.s(), m_.at.states);
  u.vector(m_.at.psi()) = Vector{};
  add(u, m_.at.psi(), m_.at.psi(), 1);
  for (int k = 0; k < m_.at.n; ++k) {
    const Vector u_v = hg * u.vector(m_.at.v() + k);
    u.vector(m_.at.v() + k) = u_v;
    u.vector(m_.at.x() + k) = hg * (u.vector(m_.at.x() + k) + u_v);
  }
  for (int k = 0; k < m_.at.states; ++k) u.vector(m_.at.s() + k) = hg * u.vector(m_.at.s() + k);
}

// (dG_q) u_q + (dG_s) u_s + (dG_v) u_v + (dG_z) u_z, with the integrand's row, for several stages
// at once: dG is by far the largest array, so it is read as few times as possible. The increments u
// of the step are known.
template <int N>
template <std::size_t together>
void RosenbrockTangent<N>::change_matrices(const OneStep<double>& step) {
  const ByVariable<Sparsity>& patterns = m_.system.patterns();
  for (std::size_t first = 0; first < m_.count(); first += together) {
    In<double> u[together];
    for (std::size_t k = 0; k < together; ++k) u[k] = step.increments()[first + k];
    for (int row = 0; row <= m_.at.z_size; ++row) {
      Vector sums[together] = {};
      add_row_tangents<N, together>(patterns.position, m_.equations.changes().position, row, u,
                                    m_.at.x(), sums);
      add_row_tangents<N, together>(patterns.velocity, m_.equations.changes().velocity, row, u,
                                    m_.at.v(), sums);
      add_row_tangents<N, together>(patterns.rate, m_.equations.changes().rate, row, u, m_.at.z(),
                                    sums);
      for (std::size_t k = 0; k < together; ++k)
        matrix_changes_[first + k].vector(row) =
            sums[k] + (step.step_size() * m_.tableau->gamma_i[first + k]) *
                          m_.equations.time_changes().vector(row);
    }
  }
}

template <int N>
void RosenbrockTangent<N>::stage_tangent(std::size_t i, const OneStep<double>& step) {
  const double hg = step.step_size() * m_.tableau->gamma;
  const ByVariable<Sparsity>& patterns = m_.system.patterns();
  const Linearization<double>& matrices = step.derivatives();
  m_.combine(m_.y.part(0, m_.at.psi()), In<double>(m_.tableau->a[i]).first(to_signed(i)), 0,
             m_.stage_y.part(0, m_.at.psi()));
  m_.equations.residual(step.stages()[i], m_.stage_y, &m_.residual);
  stage_start(i, step.step_size());
  Directions<N>& u = m_.stages[i];
  const In<double> x = u.part(m_.at.x(), m_.at.x_size), v = u.part(m_.at.v(), m_.at.n);
  const Out<double> z = u.part(m_.at.z(), m_.at.z_size);
  for (int row = 0; row < m_.at.z_size; ++row)
    u.vector(m_.at.z() + row) = -(m_.residual.vector(row) + matrix_changes_[i].vector(row));
  step.product().template subtract<N>(matrices, u.part(0, m_.at.z()), z);
  step.stage_matrix().lu().template solve_rows<N>(z);
  for (int k = 0; k < m_.at.n; ++k) {
    const Vector change = hg * u.vector(m_.at.z() + k);
    u.vector(m_.at.v() + k) += change;
    u.vector(m_.at.x() + k) += hg * change;
  }
  for (int k = 0; k < m_.at.states; ++k)
    u.vector(m_.at.s() + k) += hg * u.vector(m_.at.sigma() + k);
  Vector psi = m_.residual.vector(m_.at.z_size) + matrix_changes_[i].vector(m_.at.z_size) +
               u.vector(m_.at.psi());
  add_row_product<N>(patterns.position, matrices.position, m_.at.z_size, x, &psi);
  add_row_product<N>(patterns.velocity, matrices.velocity, m_.at.z_size, v, &psi);
  add_row_product<N>(patterns.rate, matrices.rate, m_.at.z_size, z, &psi);
  u.vector(m_.at.psi()) = hg * psi;
}

template <int N>
void RosenbrockTangent<N>::attempt(OneStep<double>* step) {
  if (!m_.has_changes) m_.linearize(step->state());
  if (m_.count() % 4 == 0)
    change_matrices<4>(*step);
  else if (m_.count() % 3 == 0)
    change_matrices<3>(*step);
  else
    change_matrices<1>(*step);
  for (std::size_t i = 0; i < m_.count(); ++i) stage_tangent(i, *step);
}

// The derivative of ExplicitStages::take_rates(), with z' from G = 0.
template <int N>
void ExplicitTangent<N>::explicit_stage(std::size_t i, OneStep<double>* step) {
  const double h = step->step_size();
  const int z_size = m_.at.z_size;
  m_.combine(m_.y.part(0, m_.at.z()), In<double>(m_.tableau->a[i]).first(to_signed(i)), 0,
             m_.stage_y.part(0, m_.at.z()));
  for (int k = 0; k < z_size; ++k) m_.stage_y.vector(m_.at.z() + k) = Vector{};
  m_.equations.residual(step->stages()[i], m_.stage_y, &m_.residual);
  const Out<double> z = m_.stage_y.part(m_.at.z(), z_size);
  for (int k = 0; k < z_size; ++k) m_.stage_y.vector(m_.at.z() + k) = -m_.residual.vector(k);
  Directions<N>& u = m_.stages[i];
  Vector psi = m_.residual.vector(z_size);
  if (const auto& [pattern, values] = step->explicit_stages().stage_factor(i); pattern) {
    pattern->template solve<N>(values, z);  // then g does not depend on z
  } else {
    step->explicit_stages().factor_stage(i);
    step->stage_matrix().lu().template solve_rows<N>(z);
    add_row_product<N>(m_.system.patterns().rate, step->derivatives().rate, z_size, z, &psi);
  }
  u.vector(m_.at.psi()) = h * psi;
  for (int k = 0; k < m_.at.n; ++k) {
    u.vector(m_.at.x() + k) = h * m_.stage_y.vector(m_.at.v() + k);
    u.vector(m_.at.v() + k) = h * m_.stage_y.vector(m_.at.z() + k);
  }
  for (int k = 0; k < m_.at.states; ++k)
    u.vector(m_.at.s() + k) = h * m_.stage_y.vector(m_.at.sigma() + k);
  for (int k = 0; k < z_size; ++k)
    u.vector(m_.at.z() + k) = m_.stage_y.vector(m_.at.z() + k) - m_.y.vector(m_.at.z() + k);
}

template <int N>
void ExplicitTangent<N>::attempt(OneStep<double>* step) {
  for (std::size_t i = 0; i < m_.count(); ++i) explicit_stage(i, step);
  estimate_.setZero();
  m_.combine(estimate_, In<double>(m_.tableau->estimate).first(m_.tableau->stages), 0, estimate_);
}

// The rates at the end are those of the last stage.
template <int N>
void ExplicitTangent<N>::finish(const OneStep<double>& step) {
  for (int k = m_.at.z(); k < m_.at.psi(); ++k) m_.y.vector(k) = m_.stage_y.vector(k);
  if (m_.layout.m > 0) m_.linearize(step.unprojected());
}

template <int N>
void ExplicitTangent<N>::interpolate_z(double theta, const Directions<N>& before) {
  const RosenbrockTableau::Row weights = rate_weights(*m_.tableau, theta);
  m_.combine(before.part(m_.at.z(), m_.at.z_size), In<double>(weights).first(m_.tableau->stages),
             m_.at.z(), m_.stage_y.part(m_.at.z(), m_.at.z_size));
}

template class RosenbrockTangent<4>;
template class RosenbrockTangent<8>;
template class ExplicitTangent<4>;
template class ExplicitTangent<8>;

}  // namespace codesign
