// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "integration/one_step.h"

#include <algorithm>
#include <cmath>
#include <complex>

#include "equations/compiled_system.h"
#include "math/arrays.h"

namespace codesign {

template <class T>
OneStep<T>::OneStep(const CompiledSystem& system, const RosenbrockTableau& tableau)
    : m_(system, tableau),
      rate_sizes_(m_.layout),
      rosenbrock_(&m_),
      explicit_(&m_),
      method_(method_of(tableau)) {
  previous_.resize(m_.layout);
  for (VectorX<T>* correction : {&position_correction_, &velocity_correction_})
    correction->setZero(m_.layout.columns());
}

template <class T>
void OneStep<T>::start(const State<T>& state, const T& psi) {
  previous_ = state;
  psi_ = previous_psi_ = psi;
  m_.h = 0.0;
  restart(state);
}

template <class T>
void OneStep<T>::restart(const State<T>& state) {
  m_.state = m_.end = state;
  m_.has_derivatives = false;
  method_->begin();
}

template <class T>
void OneStep<T>::use(const RosenbrockTableau& tableau) {
  if (m_.tableau != &tableau) explicit_.forget();
  m_.tableau = &tableau;
  method_ = method_of(tableau);
}

// If the matrix is singular here, the step that needs it reports the failure.
template <class T>
void OneStep<T>::choose_pivots(double h) {
  const double hg = h * m_.tableau->gamma;
  m_.stage_matrix.reset_pivots();
  m_.projection_matrix.reset_pivots();
  if (!method_->needs_matrix()) return;
  m_.stage_matrix.factor(m_.derivatives, hg, hg * hg, hg);
  if (m_.layout.m > 0) m_.projection_matrix.factor(m_.derivatives, 0.0, 0.0, 0.0);
}

template <class T>
void OneStep<T>::keep_pivots() {
  m_.stage_matrix.keep_pivots();
  m_.projection_matrix.keep_pivots();
}

template <class T>
void OneStep<T>::keep_pivots_of(const OneStep& other) {
  m_.stage_matrix.keep_pivots_of(other.m_.stage_matrix);
  m_.projection_matrix.keep_pivots_of(other.m_.projection_matrix);
}

// One product with f_y: q' = v, (v', s') = the parts (a, sigma) of -G_z^-1 (G_q q + G_v v + G_s s).
template <>
double OneStep<double>::spectral_radius(VectorX<double>* direction) {
  constexpr int kProducts = 2;
  if (!m_.projection_matrix.factor(m_.derivatives, 0.0, 0.0, 0.0)) return 0.0;
  VectorX<double>& w = *direction;
  const int size = m_.at.z();
  double growth = 1.0;
  for (int k = 0; k < kProducts; ++k) {
    w.head(size) /= w.head(size).norm();
    m_.z.setZero();
    rosenbrock_.product().subtract(m_.derivatives, In<double>(w).first(size), m_.z);
    m_.projection_matrix.solve(&m_.z);
    w.segment(m_.at.x(), m_.at.n) = w.segment(m_.at.v(), m_.at.n);
    w.segment(m_.at.v(), m_.at.n) = m_.z.head(m_.at.n);
    w.segment(m_.at.s(), m_.at.states) = m_.z.tail(m_.at.states);
    growth *= w.head(size).norm();
  }
  return std::sqrt(growth);
}

template <class T>
bool OneStep<T>::attempt(double h) {
  m_.h = h;
  return method_->attempt();
}

template <class T>
double OneStep<T>::error(double relative_tolerance, double absolute_tolerance) const {
  const VectorX<T>& estimate = method_->estimate();
  double largest = 0.0;
  const auto add = [&](int first, const VectorX<T>& from, const VectorX<T>& to, const auto& size) {
    for (Eigen::Index k = 0; k < from.size(); ++k) {
      const double scale =
          absolute_tolerance + relative_tolerance * std::max(size(from, k), size(to, k));
      largest = std::max(largest, std::abs(value_of(estimate[first + k])) / scale);
    }
  };
  const auto own = [](const VectorX<T>& y, Eigen::Index k) { return std::abs(value_of(y[k])); };
  const auto of_rate = [this](const VectorX<T>& y, Eigen::Index k) { return rate_sizes_.of(y, k); };
  add(m_.at.x(), m_.state.q, m_.end.q, own);
  add(m_.at.v(), m_.state.v, m_.end.v, of_rate);
  add(m_.at.s(), m_.state.s, m_.end.s, own);
  return method_->caution() * largest;
}

template <class T>
T OneStep<T>::next_psi() const {
  T end = psi_;
  for (std::size_t j = 0; j < m_.count(); ++j)
    end += T(m_.tableau->weights[j]) * m_.increments[j][m_.at.psi()];
  return end;
}

template <class T>
double OneStep<T>::psi_error(double relative_tolerance, double absolute_tolerance) const {
  const auto size = [](const T& value) { return std::abs(value_of(value)); };
  const double scale =
      absolute_tolerance + relative_tolerance * std::max(size(psi_), size(next_psi()));
  return size(method_->estimate()[m_.at.psi()]) / scale;
}

template <class T>
bool OneStep<T>::accept() {
  previous_ = m_.state;
  previous_psi_ = psi_;
  psi_ = next_psi();
  return finish(true);
}

template <class T>
bool OneStep<T>::resume(const State<T>& unprojected) {
  m_.end = unprojected;
  return finish(false);
}

template <class T>
bool OneStep<T>::finish(bool is_last) {
  m_.has_derivatives = false;
  method_->finish(is_last);
  return project();
}

// [G_a G_lambda; Phi_q 0] [delta; mu] = [0; -error], once for positions and once for velocities at
// the new positions.
template <class T>
bool OneStep<T>::project() {
  m_.state = m_.end;
  // Without constraints the corrections are zero and the matrix is not needed.
  if (m_.layout.m == 0) {
    for (VectorX<T>* correction : {&position_correction_, &velocity_correction_})
      correction->setZero(m_.layout.columns());
    return std::isfinite(value_of(m_.state.q.sum() + m_.state.v.sum()));
  }
  if (!m_.projection_matrix.factor(m_.derivatives, 0.0, 0.0, 0.0)) return false;
  const auto correct = [this](const VectorX<T>& error, VectorX<T>* correction, VectorX<T>* target) {
    correction->setZero(m_.layout.columns());
    correction->segment(m_.layout.n, m_.layout.m) = -error;
    m_.projection_matrix.solve(correction);
    *target += correction->head(m_.layout.n);
  };
  m_.equations.constraint_errors(m_.state, &constraint_, &constraint_rate_);
  correct(constraint_, &position_correction_, &m_.state.q);
  m_.equations.constraint_errors(m_.state, &constraint_, &constraint_rate_);
  correct(constraint_rate_, &velocity_correction_, &m_.state.v);
  return std::isfinite(value_of(position_correction_.sum() + velocity_correction_.sum()));
}

template class OneStep<double>;
template class OneStep<std::complex<double>>;

}  // namespace codesign
