// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
// The dense output of RosenbrockStep.
#include <complex>

#include "integration/rosenbrock_step.h"
#include "math/arrays.h"

namespace codesign {

template <class T>
void RosenbrockStep<T>::interpolate(double theta, const RosenbrockTableau::Row& weights,
                                    const State<T>& from, const State<T>& to,
                                    State<T>* state) const {
  *state = from;
  const T left(1.0 - theta), right(theta);
  const auto blend = [&](const auto& before, const auto& after, auto* y) {
    *y = left * before + right * after;
  };
  blend(from.q, to.q, &state->q);
  blend(from.v, to.v, &state->v);
  blend(from.s, to.s, &state->s);
  blend(from.z, to.z, &state->z);
  combine(at_, *state, In<double>(weights).first(tableau_->stages), increments_, state);
  if (tableau_->is_explicit())
    combine(from.z, In<double>(rate_weights(*tableau_, theta)).first(tableau_->stages), increments_,
            at_.z(), state->z);
  state->t = from.t + theta * h_;
  turns_.follow(from, &equations_, state);
}

template <class T>
void RosenbrockStep<T>::interpolate(double theta, State<T>* state, T* psi) const {
  const RosenbrockTableau::Row weights = dense_weights(*tableau_, theta);
  interpolate(theta, weights, previous_, state_, state);
  *psi = T(1.0 - theta) * previous_psi_ + T(theta) * psi_;
  for (std::size_t j = 0; j < count(); ++j) *psi += T(weights[j]) * increments_[j][at_.psi()];
}

template <class T>
void RosenbrockStep<T>::interpolate_attempt(double theta, State<T>* state) const {
  interpolate(theta, dense_weights(*tableau_, theta), state_, end_, state);
}

template <class T>
void RosenbrockStep<T>::interpolate_rates(double theta, State<T>* rates) const {
  const T per_time(1.0 / h_);
  RosenbrockTableau::Row weights = dense_weight_slopes(*tableau_, theta);
  for (double& weight : weights) weight /= h_;
  rates->t = previous_.t + theta * h_;
  rates->q = per_time * (state_.q - previous_.q);
  rates->v = per_time * (state_.v - previous_.v);
  rates->s = per_time * (state_.s - previous_.s);
  rates->z = per_time * (state_.z - previous_.z);
  combine(at_, *rates, In<double>(weights).first(tableau_->stages), increments_, rates);
  if (!tableau_->is_explicit()) return;
  weights = dense_weight_curvatures(*tableau_, theta);
  for (double& weight : weights) weight /= h_;
  rates->z.setZero();
  combine(rates->z, In<double>(weights).first(tableau_->stages), increments_, at_.z(), rates->z);
}

template void RosenbrockStep<double>::interpolate(double, State<double>*, double*) const;
template void RosenbrockStep<double>::interpolate_attempt(double, State<double>*) const;
template void RosenbrockStep<double>::interpolate_rates(double, State<double>*) const;
template void RosenbrockStep<std::complex<double>>::interpolate(double,
                                                                State<std::complex<double>>*,
                                                                std::complex<double>*) const;
template void RosenbrockStep<std::complex<double>>::interpolate_attempt(
    double, State<std::complex<double>>*) const;
template void RosenbrockStep<std::complex<double>>::interpolate_rates(
    double, State<std::complex<double>>*) const;

}  // namespace codesign
