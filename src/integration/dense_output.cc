// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
// The dense output of OneStep.
#include <complex>

#include "integration/one_step.h"
#include "math/arrays.h"

namespace codesign {

template <class T>
void OneStep<T>::interpolate(double theta, const RosenbrockTableau::Row& weights,
                             const State<T>& from, const State<T>& to, State<T>* state) const {
  *state = from;
  const T left(1.0 - theta), right(theta);
  const auto blend = [&](const auto& before, const auto& after, auto* y) {
    *y = left * before + right * after;
  };
  blend(from.q, to.q, &state->q);
  blend(from.v, to.v, &state->v);
  blend(from.s, to.s, &state->s);
  blend(from.z, to.z, &state->z);
  combine(m_.at, *state, m_.of_stages(weights), m_.increments, state);
  method_->interpolate_z(theta, from, state);
  state->t = from.t + theta * m_.h;
  m_.turns.follow(from, &m_.equations, state);
}

template <class T>
void OneStep<T>::interpolate(double theta, State<T>* state, T* psi) const {
  const RosenbrockTableau::Row weights = dense_weights(*m_.tableau, theta);
  interpolate(theta, weights, previous_, m_.state, state);
  *psi = T(1.0 - theta) * previous_psi_ + T(theta) * psi_;
  for (std::size_t j = 0; j < m_.count(); ++j)
    *psi += T(weights[j]) * m_.increments[j][m_.at.psi()];
}

template <class T>
void OneStep<T>::interpolate_attempt(double theta, State<T>* state) const {
  interpolate(theta, dense_weights(*m_.tableau, theta), m_.state, m_.end, state);
}

template <class T>
void OneStep<T>::interpolate_rates(double theta, State<T>* rates) const {
  const T per_time(1.0 / m_.h);
  RosenbrockTableau::Row weights = dense_weight_slopes(*m_.tableau, theta);
  for (double& weight : weights) weight /= m_.h;
  rates->t = previous_.t + theta * m_.h;
  rates->q = per_time * (m_.state.q - previous_.q);
  rates->v = per_time * (m_.state.v - previous_.v);
  rates->s = per_time * (m_.state.s - previous_.s);
  rates->z = per_time * (m_.state.z - previous_.z);
  combine(m_.at, *rates, m_.of_stages(weights), m_.increments, rates);
  method_->interpolate_z_rates(theta, rates);
}

template void OneStep<double>::interpolate(double, State<double>*, double*) const;
template void OneStep<double>::interpolate_attempt(double, State<double>*) const;
template void OneStep<double>::interpolate_rates(double, State<double>*) const;
template void OneStep<std::complex<double>>::interpolate(double, State<std::complex<double>>*,
                                                         std::complex<double>*) const;
template void OneStep<std::complex<double>>::interpolate_attempt(
    double, State<std::complex<double>>*) const;
template void OneStep<std::complex<double>>::interpolate_rates(double,
                                                               State<std::complex<double>>*) const;

}  // namespace codesign
