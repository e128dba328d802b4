// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "integration/rosenbrock_stages.h"

#include <algorithm>
#include <cmath>
#include <complex>

#include "equations/compiled_system.h"
#include "math/arrays.h"

namespace codesign {

// Sets w of (16) in increment i: w_v = h gamma r_v, w_q = h gamma (r_q + w_v), w_s = h gamma r_s,
// where r is the stage's rate plus the sum of c_ij u_j / h.
template <class T>
void RosenbrockStages<T>::stage_start(std::size_t i) {
  const T hg(m_.h * m_.tableau->gamma);
  const State<T>& stage = m_.stages[i];
  VectorX<T>& u = m_.increments[i];
  RosenbrockTableau::Row factors;
  for (std::size_t j = 0; j < i; ++j) factors[j] = m_.tableau->c[i][j] / m_.h;
  const In<double> given = In<double>(factors).first(to_signed(i));
  u.segment(m_.at.x(), m_.at.n) = stage.v;
  u.segment(m_.at.s(), m_.at.states) = stage.z.tail(m_.at.states);
  u.segment(m_.at.v(), m_.at.n) = stage.z.head(m_.at.n);
  combine(In<T>(u).first(m_.at.z()), given, m_.increments, 0, Out<T>(u).first(m_.at.z()));
  u[m_.at.psi()] = T(0.0);
  for (std::size_t j = 0; j < i; ++j) u[m_.at.psi()] += factors[j] * m_.increments[j][m_.at.psi()];
  u.segment(m_.at.v(), m_.at.n) *= hg;
  u.segment(m_.at.x(), m_.at.n) =
      hg * (u.segment(m_.at.x(), m_.at.n) + u.segment(m_.at.v(), m_.at.n));
  u.segment(m_.at.s(), m_.at.states) *= hg;
}

// Solves (16) for u_z of stage i, then adds h gamma u_a to w_v, and its like to w_q and w_s.
template <class T>
bool RosenbrockStages<T>::solve_stage(std::size_t i) {
  VectorX<T>& u = m_.increments[i];
  const T hg(m_.h * m_.tableau->gamma), time_shift(m_.h * m_.tableau->gamma_i[i]);
  T g(0.0);
  combine(m_.at, m_.state, In<double>(m_.tableau->a[i]).first(to_signed(i)), m_.increments,
          &m_.stages[i]);
  m_.stages[i].t = m_.state.t + m_.tableau->alpha[i] * m_.h;
  m_.turns.follow(m_.state, &m_.equations, &m_.stages[i]);
  m_.equations.residual(m_.stages[i], &m_.residual, &g);
  stage_start(i);
  const ByVariable<Sparsity>& patterns = m_.system.patterns();
  const In<T> all = u, x = all.first(m_.at.x_size), v = all.subspan(m_.at.v(), m_.at.n),
              z = all.subspan(m_.at.z(), m_.at.z_size);
  m_.z = -m_.residual - time_shift * m_.derivatives.time.head(m_.at.z_size);
  product_.subtract(m_.derivatives, all.first(m_.at.z()), m_.z);
  m_.stage_matrix.solve(&m_.z);
  u.segment(m_.at.z(), m_.at.z_size) = m_.z;
  u.segment(m_.at.v(), m_.at.n) += hg * m_.z.head(m_.at.n);
  u.segment(m_.at.x(), m_.at.n) += hg * hg * m_.z.head(m_.at.n);
  u.segment(m_.at.s(), m_.at.states) += hg * m_.z.tail(m_.at.states);
  const int last = m_.at.z_size;
  u[m_.at.psi()] = hg * (g + u[m_.at.psi()] + time_shift * m_.derivatives.time[last] +
                         row_product(patterns.position, m_.derivatives.position, last, x) +
                         row_product(patterns.velocity, m_.derivatives.velocity, last, v) +
                         row_product(patterns.rate, m_.derivatives.rate, last, z));
  return std::isfinite(value_of(u[m_.at.psi()])) && std::isfinite(value_of(m_.z.sum()));
}

template <class T>
bool RosenbrockStages<T>::attempt() {
  const double hg = m_.h * m_.tableau->gamma;
  if (!m_.has_derivatives) m_.linearize_end();
  if (!m_.stage_matrix.factor(m_.derivatives, hg, hg * hg, hg)) return false;
  for (std::size_t i = 0; i < m_.count(); ++i)
    if (!solve_stage(i)) return false;
  combine(m_.at, m_.state, m_.of_stages(m_.tableau->weights), m_.increments, &m_.end);
  m_.end.t = m_.state.t + m_.h;
  m_.turns.follow(m_.state, &m_.equations, &m_.end);
  return true;
}

template class RosenbrockStages<double>;
template class RosenbrockStages<std::complex<double>>;

}  // namespace codesign
