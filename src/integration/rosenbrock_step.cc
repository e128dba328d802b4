// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "mechanism_codesign/integration/rosenbrock_step.h"

#include <algorithm>
#include <cmath>

namespace codesign {
namespace {

template <class T>
void copy_state(const State<T>& from, State<T>* to) {
  to->t = from.t;
  to->q = from.q;
  to->v = from.v;
  to->s = from.s;
  to->z = from.z;
}

template <class T>
void add_scaled(double factor, const Increment<T>& u, State<T>* y) {
  if (factor == 0.0) return;
  y->q += T(factor) * u.q;
  y->v += T(factor) * u.v;
  y->s += T(factor) * u.s;
  y->z += T(factor) * u.z;
}

/// result += G_q q + G_s s + G_v v, the increment's z left out.
template <class T>
void add_product(const System& system, const Linearization<T>& d, const Increment<T>& u, VectorX<T>* result) {
  const Sparsity& pattern = system.sparsity();
  const Layout& layout = system.layout();
  const int *start = pattern.column_start.data(), *row = pattern.row_index.data();
  T* y = result->data();
  for (int column = 0; column < layout.n; ++column) {
    const T q = u.q[column], v = u.v[column];
    for (int k = start[column]; k < start[column + 1]; ++k)
      y[row[k]] += d.by_position[static_cast<std::size_t>(k)] * q + d.by_velocity[static_cast<std::size_t>(k)] * v;
  }
  for (int state = 0; state < layout.states; ++state) {
    const int column = layout.state_column(state);
    for (int k = start[column]; k < start[column + 1]; ++k) y[row[k]] += d.by_position[static_cast<std::size_t>(k)] * u.s[state];
  }
}

}  // namespace

template <class T>
T RosenbrockStep<T>::integrand_product(const Increment<T>& u) const {
  T sum(0.0);
  for (const auto& [column, e] : system_.integrand_entries()) {
    sum += derivatives_.by_rate[e] * u.z[column];
    if (column < layout_.n) sum += derivatives_.by_position[e] * u.q[column] + derivatives_.by_velocity[e] * u.v[column];
    if (column >= layout_.state_column(0)) sum += derivatives_.by_position[e] * u.s[column - layout_.state_column(0)];
  }
  return sum;
}

template <class T>
RosenbrockStep<T>::RosenbrockStep(const System& system, const RosenbrockTableau& tableau)
    : system_(system),
      layout_(system.layout()),
      tableau_(tableau),
      equations_(system),
      stage_matrix_(system),
      projection_matrix_(system),
      increments_(static_cast<std::size_t>(tableau.stages)) {
  derivatives_.resize(system.sparsity().nonzeros());
  for (State<T>* state : {&state_, &previous_, &stage_, &end_, &projection_}) state->resize(layout_);
  for (Increment<T>& u : increments_) u.resize(layout_);
  sum_.resize(layout_);
  correction_.resize(layout_);
  right_hand_side_.setZero(layout_.columns() + 1);
  velocity_multipliers_.setZero(layout_.columns());
}

template <class T>
void RosenbrockStep<T>::start(const State<T>& state) {
  copy_state(state, &state_);
  copy_state(state, &previous_);
  psi_ = previous_psi_ = T(0.0);
  h_ = 0.0;
  equations_.linearize(state_, &derivatives_);
}

template <class T>
void RosenbrockStep<T>::stage_state(int i, double h) {
  const auto row = static_cast<std::size_t>(i);
  copy_state(state_, &stage_);
  sum_.q.setZero();
  sum_.v.setZero();
  sum_.s.setZero();
  sum_.psi = T(0.0);
  for (std::size_t j = 0; j < row; ++j) {
    const Increment<T>& u = increments_[j];
    add_scaled(tableau_.a[row][j], u, &stage_);
    const T c(tableau_.c[row][j] / h);
    sum_.q += c * u.q;
    sum_.v += c * u.v;
    sum_.s += c * u.s;
    sum_.psi += c * u.psi;
  }
  stage_.t = state_.t + tableau_.alpha[row] * h;
}

// With w_v = h gamma r_v, w_q = h gamma (r_q + w_v), w_s = h gamma r_s, the stage's matrix gives u_z and then u_v = w_v + h gamma u_a etc.
template <class T>
bool RosenbrockStep<T>::solve_stage(int i, double h) {
  Increment<T>& u = increments_[static_cast<std::size_t>(i)];
  const T hg(h * tableau_.gamma);
  T g(0.0);
  stage_state(i, h);
  equations_.residual(stage_, &residual_, &g);
  const auto a = stage_.z.head(layout_.n), sigma = stage_.z.tail(layout_.states);
  u.v = hg * (a + sum_.v);
  u.q = hg * (stage_.v + sum_.q + u.v);
  u.s = hg * (sigma + sum_.s);
  right_hand_side_.setZero();
  add_product(system_, derivatives_, u, &right_hand_side_);
  u.z = -(residual_ + right_hand_side_.head(layout_.columns()));
  stage_matrix_.solve(&u.z);
  u.v += hg * u.z.head(layout_.n);
  u.q += hg * hg * u.z.head(layout_.n);
  u.s += hg * u.z.tail(layout_.states);
  u.psi = hg * (g + sum_.psi + integrand_product(u));
  return std::isfinite(value_of(u.psi)) && std::isfinite(value_of(u.z.sum()));
}

template <class T>
bool RosenbrockStep<T>::attempt(double h) {
  const double hg = h * tableau_.gamma;
  h_ = h;
  if (!stage_matrix_.factor(derivatives_, hg, hg * hg, hg)) return false;
  for (int i = 0; i < tableau_.stages; ++i)
    if (!solve_stage(i, h)) return false;
  copy_state(state_, &end_);
  for (std::size_t j = 0; j < increments_.size(); ++j) add_scaled(tableau_.weights[j], increments_[j], &end_);
  end_.t = state_.t + h;
  return true;
}

template <class T>
double RosenbrockStep<T>::error(double relative_tolerance, double absolute_tolerance) const {
  const Increment<T>& estimate = increments_.back();
  double sum = 0.0;
  const auto add = [&](const VectorX<T>& e, const VectorX<T>& from, const VectorX<T>& to) {
    for (Eigen::Index k = 0; k < e.size(); ++k) {
      const double scale = absolute_tolerance + relative_tolerance * std::max(std::abs(value_of(from[k])), std::abs(value_of(to[k])));
      const double x = value_of(e[k]) / scale;
      sum += x * x;
    }
  };
  add(estimate.q, state_.q, end_.q);
  add(estimate.v, state_.v, end_.v);
  add(estimate.s, state_.s, end_.s);
  return std::sqrt(sum / (2.0 * layout_.n + layout_.states));
}

template <class T>
bool RosenbrockStep<T>::accept() {
  copy_state(state_, &previous_);
  previous_psi_ = psi_;
  for (std::size_t j = 0; j < increments_.size(); ++j) psi_ += T(tableau_.weights[j]) * increments_[j].psi;
  equations_.linearize(end_, &derivatives_);
  return project();
}

// [G_a G_lambda; Phi_q 0] [delta; mu] = [0; -error], once for positions and once for velocities at the new positions.
template <class T>
bool RosenbrockStep<T>::project() {
  copy_state(end_, &state_);
  if (!projection_matrix_.factor(derivatives_, 0.0, 0.0, 0.0)) return false;
  const auto correct = [this](const VectorX<T>& error, VectorX<T>* solution, VectorX<T>* delta, VectorX<T>* target) {
    solution->setZero(layout_.columns());
    solution->segment(layout_.n, layout_.m) = -error;
    projection_matrix_.solve(solution);
    *delta = solution->head(layout_.n);
    *target += *delta;
  };
  equations_.constraint_errors(state_.q, state_.v, &constraint_, &constraint_rate_);
  correct(constraint_, &correction_.z, &correction_.q, &state_.q);
  equations_.constraint_errors(state_.q, state_.v, &constraint_, &constraint_rate_);
  correct(constraint_rate_, &velocity_multipliers_, &correction_.v, &state_.v);
  return std::isfinite(value_of(correction_.q.sum() + correction_.v.sum()));
}

template <class T>
void RosenbrockStep<T>::interpolate(double theta, State<T>* state, T* psi) const {
  copy_state(previous_, state);
  const T left(1.0 - theta), right(theta);
  const auto blend = [&](const auto& from, const auto& to, auto* y) { *y = left * from + right * to; };
  blend(previous_.q, state_.q, &state->q);
  blend(previous_.v, state_.v, &state->v);
  blend(previous_.s, state_.s, &state->s);
  blend(previous_.z, state_.z, &state->z);
  *psi = left * previous_psi_ + right * psi_;
  for (std::size_t j = 0; j < increments_.size(); ++j) {
    double weight = 0.0;
    for (int k = tableau_.dense_terms - 1; k >= 0; --k) weight = weight * theta + tableau_.dense[static_cast<std::size_t>(k)][j];
    weight *= theta * (1.0 - theta);
    add_scaled(weight, increments_[j], state);
    *psi += T(weight) * increments_[j].psi;
  }
  state->t = previous_.t + theta * h_;
}

template class RosenbrockStep<double>;
template class RosenbrockStep<std::complex<double>>;

}  // namespace codesign
