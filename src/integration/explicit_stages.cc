// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "integration/explicit_stages.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <type_traits>

#include "equations/compiled_system.h"
#include "math/arrays.h"

namespace codesign {
namespace {

template <class T>
double largest(const VectorX<T>& x) {
  double size = 0.0;
  for (const T& entry : x) size = std::max(size, std::abs(entry));
  return x.allFinite() ? size : std::numeric_limits<double>::infinity();
}

}  // namespace

template <class T>
void ExplicitStages<T>::begin() {
  has_first_ = false;
  if (needs_matrix()) m_.equations.rates(m_.state, &m_.residual, &first_g_, &m_.derivatives);
}

template <class T>
bool ExplicitStages<T>::needs_matrix() {
  return !std::is_same_v<T, double> || !m_.equations.mass_factor();
}

// Newton's iteration with G_z of its first point, from which the solution is near: G is affine in z
// unless friction depends on reactions. Complex numbers converge one part after the other and need
// G_z again.
template <class T>
bool ExplicitStages<T>::solve_rates(State<T>* at, T* g, StageFactor* factor) {
  constexpr bool kIsReal = std::is_same_v<T, double>;
  if constexpr (kIsReal)
    if (m_.equations.accelerations(at, g, &factor->values)) {
      factor->pattern = m_.equations.mass_factor();
      return std::isfinite(at->z.sum() + *g);
    }
  factor->pattern = nullptr;
  constexpr int kMost = 30, kLeast = kIsReal ? 1 : 3;
  constexpr double kConverged = 1e-14;
  // With redundant rows, rounding over the compliance remains in reactions that are not unique.
  const double rounding = m_.system.compliance() == 0.0 ? 1e-9 : 1e-7;
  double previous = std::numeric_limits<double>::infinity();
  bool refresh = true;
  for (int k = 0; k < kMost; ++k) {
    if (refresh) m_.equations.rates(*at, &m_.residual, g, &m_.derivatives);
    if (refresh && !m_.stage_matrix.factor(m_.derivatives, 0.0, 0.0, 0.0)) return false;
    if (!refresh) m_.equations.residual(*at, &m_.residual, g);
    m_.z = -m_.residual;
    m_.stage_matrix.solve(&m_.z);
    at->z += m_.z;
    const double size = largest(m_.z) / (1.0 + largest(at->z));
    if (!std::isfinite(size)) return false;
    if (k >= kLeast && (size <= kConverged || (size <= rounding && size > 0.25 * previous)))
      return std::isfinite(value_of(*g));
    refresh = !kIsReal || size > 0.25 * previous;
    previous = size;
  }
  return false;
}

template <class T>
void ExplicitStages<T>::take_rates(std::size_t i, const T& g) {
  const State<T>& stage = m_.stages[i];
  VectorX<T>& u = m_.increments[i];
  const T h(m_.h);
  u.segment(m_.at.x(), m_.at.n) = h * stage.v;
  u.segment(m_.at.s(), m_.at.states) = h * stage.z.tail(m_.at.states);
  u.segment(m_.at.v(), m_.at.n) = h * stage.z.head(m_.at.n);
  u.segment(m_.at.z(), m_.at.z_size) = stage.z - m_.state.z;
  u[m_.at.psi()] = h * g;
}

// The last stage is at the end of the step; without constraints it is the next step's first one.
template <class T>
bool ExplicitStages<T>::attempt() {
  if (!has_first_) first_ = m_.state;
  if (!has_first_ && !solve_rates(&first_, &first_g_, &first_factor_)) return false;
  has_first_ = true;
  m_.has_derivatives = false;
  first_.turns = m_.state.turns;
  m_.stages[0] = first_;
  factors_[0] = first_factor_;
  take_rates(0, first_g_);
  for (std::size_t i = 1; i < m_.count(); ++i) {
    const In<double> factors = In<double>(m_.tableau->a[i]).first(to_signed(i));
    State<T>& stage = m_.stages[i];
    combine(m_.state.q, factors, m_.increments, m_.at.x(), stage.q);
    combine(m_.state.s, factors, m_.increments, m_.at.s(), stage.s);
    combine(m_.state.v, factors, m_.increments, m_.at.v(), stage.v);
    stage.z = m_.stages[i - 1].z;
    stage.t = m_.state.t + m_.tableau->alpha[i] * m_.h;
    m_.turns.follow(m_.state, &m_.equations, &stage);
    if (!solve_rates(&stage, &last_g_, &factors_[i])) return false;
    take_rates(i, last_g_);
  }
  m_.end = m_.stages[m_.count() - 1];
  estimate_.setZero();
  combine(estimate_, In<double>(m_.tableau->estimate).first(m_.tableau->stages), m_.increments, 0,
          estimate_);
  return std::isfinite(value_of(estimate_.sum()));
}

template <class T>
bool ExplicitStages<T>::factor_stage(std::size_t i) {
  T g(0.0);
  m_.equations.rates(m_.stages[i], &m_.residual, &g, &m_.derivatives);
  return m_.stage_matrix.factor(m_.derivatives, 0.0, 0.0, 0.0);
}

template <class T>
void ExplicitStages<T>::finish(bool is_last) {
  if (is_last && m_.layout.m == 0) {
    first_ = m_.end;
    first_g_ = last_g_;
    first_factor_ = factors_[m_.count() - 1];
    return;
  }
  has_first_ = false;
  T g(0.0);
  if (m_.layout.m > 0) m_.equations.rates(m_.end, &m_.residual, &g, &m_.derivatives);
}

template <class T>
void ExplicitStages<T>::interpolate_z(double theta, const State<T>& from, State<T>* state) const {
  combine(from.z, m_.of_stages(rate_weights(*m_.tableau, theta)), m_.increments, m_.at.z(),
          state->z);
}

template <class T>
void ExplicitStages<T>::interpolate_z_rates(double theta, State<T>* rates) const {
  RosenbrockTableau::Row weights = dense_weight_curvatures(*m_.tableau, theta);
  for (double& weight : weights) weight /= m_.h;
  rates->z.setZero();
  combine(rates->z, m_.of_stages(weights), m_.increments, m_.at.z(), rates->z);
}

template class ExplicitStages<double>;
template class ExplicitStages<std::complex<double>>;

}  // namespace codesign
