// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "integration/rosenbrock_step.h"

#include <algorithm>
#include <cmath>
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
RosenbrockStep<T>::RosenbrockStep(const CompiledSystem& system, const RosenbrockTableau& tableau)
    : system_(system),
      layout_(system.layout()),
      at_(layout_),
      rate_sizes_(layout_),
      tableau_(&tableau),
      equations_(system),
      turns_(system),
      stage_matrix_(system),
      projection_matrix_(system),
      product_(system),
      increments_(to_index(std::max(tableau.stages, most_stages(system.study().solver.method))),
                  VectorX<T>::Zero(at_.size())),
      stages_(increments_.size()),
      factors_(increments_.size()) {
  derivatives_.resize(system.patterns());
  for (State<T>* state : {&state_, &previous_, &end_, &first_}) state->resize(layout_);
  for (State<T>& stage : stages_) stage.resize(layout_);
  for (VectorX<T>* z : {&z_, &position_correction_, &velocity_correction_})
    z->setZero(layout_.columns());
  estimate_.setZero(at_.size());
}

template <class T>
void RosenbrockStep<T>::start(const State<T>& state, const T& psi) {
  state_ = state;
  previous_ = state;
  psi_ = previous_psi_ = psi;
  h_ = 0.0;
  linearize_start();
}

template <class T>
void RosenbrockStep<T>::restart(const State<T>& state) {
  state_ = state;
  linearize_start();
}

template <class T>
void RosenbrockStep<T>::linearize_start() {
  end_ = state_;
  has_first_ = has_derivatives_ = false;
  if (!tableau_->is_explicit())
    linearize_end();
  else if (needs_matrix())
    equations_.rates(state_, &residual_, &first_g_, &derivatives_);
}

template <class T>
void RosenbrockStep<T>::linearize_end() {
  equations_.linearize(end_, &derivatives_);
  has_derivatives_ = true;
}

template <class T>
void RosenbrockStep<T>::use(const RosenbrockTableau& tableau) {
  if (tableau_ != &tableau) has_first_ = false;
  tableau_ = &tableau;
}

// If the matrix is singular here, the step that needs it reports the failure.
template <class T>
void RosenbrockStep<T>::choose_pivots(double h) {
  const double hg = h * tableau_->gamma;
  stage_matrix_.reset_pivots();
  projection_matrix_.reset_pivots();
  if (!needs_matrix()) return;
  stage_matrix_.factor(derivatives_, hg, hg * hg, hg);
  if (layout_.m > 0) projection_matrix_.factor(derivatives_, 0.0, 0.0, 0.0);
}

template <class T>
void RosenbrockStep<T>::keep_pivots() {
  stage_matrix_.keep_pivots();
  projection_matrix_.keep_pivots();
}

template <class T>
void RosenbrockStep<T>::keep_pivots_of(const RosenbrockStep& other) {
  stage_matrix_.keep_pivots_of(other.stage_matrix_);
  projection_matrix_.keep_pivots_of(other.projection_matrix_);
}

// Sets w of (16) in increment i: w_v = h gamma r_v, w_q = h gamma (r_q + w_v), w_s = h gamma r_s,
// where r is the stage's rate plus the sum of c_ij u_j / h.
template <class T>
void RosenbrockStep<T>::stage_start(std::size_t i) {
  const T hg(h_ * tableau_->gamma);
  const State<T>& stage = stages_[i];
  VectorX<T>& u = increments_[i];
  RosenbrockTableau::Row factors;
  for (std::size_t j = 0; j < i; ++j) factors[j] = tableau_->c[i][j] / h_;
  const auto add = [&](In<T> rate, int first) {
    combine(rate, In<double>(factors).first(to_signed(i)), increments_, first,
            Out<T>(u).subspan(first, rate.size()));
  };
  add(In<T>(stage.z).first(at_.n), at_.v());
  add(stage.v, at_.x());
  add(In<T>(stage.z).subspan(at_.z_size - at_.states, at_.states), at_.s());
  u[at_.psi()] = T(0.0);
  add(In<T>(u).subspan(at_.psi(), 1), at_.psi());
  u.segment(at_.v(), at_.n) *= hg;
  u.segment(at_.x(), at_.n) = hg * (u.segment(at_.x(), at_.n) + u.segment(at_.v(), at_.n));
  u.segment(at_.s(), at_.states) *= hg;
}

// Solves (16) for u_z of stage i, then adds h gamma u_a to w_v, and its like to w_q and w_s.
template <class T>
bool RosenbrockStep<T>::solve_stage(std::size_t i) {
  VectorX<T>& u = increments_[i];
  const T hg(h_ * tableau_->gamma), time_shift(h_ * tableau_->gamma_i[i]);
  T g(0.0);
  combine(at_, state_, In<double>(tableau_->a[i]).first(to_signed(i)), increments_, &stages_[i]);
  stages_[i].t = state_.t + tableau_->alpha[i] * h_;
  turns_.follow(state_, &equations_, &stages_[i]);
  equations_.residual(stages_[i], &residual_, &g);
  stage_start(i);
  const ByVariable<Sparsity>& patterns = system_.patterns();
  const In<T> all = u, x = all.first(at_.x_size), v = all.subspan(at_.v(), at_.n),
              z = all.subspan(at_.z(), at_.z_size);
  z_ = -residual_ - time_shift * derivatives_.time.head(at_.z_size);
  product_.subtract(derivatives_, all.first(at_.z()), z_);
  stage_matrix_.solve(&z_);
  u.segment(at_.z(), at_.z_size) = z_;
  u.segment(at_.v(), at_.n) += hg * z_.head(at_.n);
  u.segment(at_.x(), at_.n) += hg * hg * z_.head(at_.n);
  u.segment(at_.s(), at_.states) += hg * z_.tail(at_.states);
  const int last = at_.z_size;
  u[at_.psi()] = hg * (g + u[at_.psi()] + time_shift * derivatives_.time[last] +
                       row_product(patterns.position, derivatives_.position, last, x) +
                       row_product(patterns.velocity, derivatives_.velocity, last, v) +
                       row_product(patterns.rate, derivatives_.rate, last, z));
  return std::isfinite(value_of(u[at_.psi()])) && std::isfinite(value_of(z_.sum()));
}

// Newton's iteration with G_z of its first point, from which the solution is near: G is affine in z
// unless friction depends on reactions. Complex numbers converge one part after the other and need
// G_z again.
template <class T>
bool RosenbrockStep<T>::solve_rates(State<T>* at, T* g, StageFactor* factor) {
  constexpr bool kIsReal = std::is_same_v<T, double>;
  if constexpr (kIsReal)
    if (equations_.accelerations(at, g, &factor->values)) {
      factor->pattern = equations_.mass_factor();
      return std::isfinite(at->z.sum() + *g);
    }
  factor->pattern = nullptr;
  constexpr int kMost = 30, kLeast = kIsReal ? 1 : 3;
  constexpr double kConverged = 1e-14;
  // With redundant rows, rounding over the compliance remains in reactions that are not unique.
  const double rounding = system_.compliance() == 0.0 ? 1e-9 : 1e-7;
  double previous = std::numeric_limits<double>::infinity();
  bool refresh = true;
  for (int k = 0; k < kMost; ++k) {
    if (refresh) equations_.rates(*at, &residual_, g, &derivatives_);
    if (refresh && !stage_matrix_.factor(derivatives_, 0.0, 0.0, 0.0)) return false;
    if (!refresh) equations_.residual(*at, &residual_, g);
    z_ = -residual_;
    stage_matrix_.solve(&z_);
    at->z += z_;
    const double size = largest(z_) / (1.0 + largest(at->z));
    if (!std::isfinite(size)) return false;
    if (k >= kLeast && (size <= kConverged || (size <= rounding && size > 0.25 * previous)))
      return std::isfinite(value_of(*g));
    refresh = !kIsReal || size > 0.25 * previous;
    previous = size;
  }
  return false;
}

template <class T>
void RosenbrockStep<T>::take_rates(std::size_t i, const T& g) {
  const State<T>& stage = stages_[i];
  VectorX<T>& u = increments_[i];
  const T h(h_);
  u.segment(at_.x(), at_.n) = h * stage.v;
  u.segment(at_.s(), at_.states) = h * stage.z.tail(at_.states);
  u.segment(at_.v(), at_.n) = h * stage.z.head(at_.n);
  u.segment(at_.z(), at_.z_size) = stage.z - state_.z;
  u[at_.psi()] = h * g;
}

// One product with f_y: q' = v, (v', s') = the parts (a, sigma) of -G_z^-1 (G_q q + G_v v + G_s s).
template <>
double RosenbrockStep<double>::spectral_radius(VectorX<double>* direction) {
  constexpr int kProducts = 2;
  if (!projection_matrix_.factor(derivatives_, 0.0, 0.0, 0.0)) return 0.0;
  VectorX<double>& w = *direction;
  const int size = at_.z();
  double growth = 1.0;
  for (int k = 0; k < kProducts; ++k) {
    w.head(size) /= w.head(size).norm();
    z_.setZero();
    product_.subtract(derivatives_, In<double>(w).first(size), z_);
    projection_matrix_.solve(&z_);
    w.segment(at_.x(), at_.n) = w.segment(at_.v(), at_.n);
    w.segment(at_.v(), at_.n) = z_.head(at_.n);
    w.segment(at_.s(), at_.states) = z_.tail(at_.states);
    growth *= w.head(size).norm();
  }
  return std::sqrt(growth);
}

// The last stage is at the end of the step; without constraints it is the next step's first one.
template <class T>
bool RosenbrockStep<T>::attempt_explicitly() {
  if (!has_first_) first_ = state_;
  if (!has_first_ && !solve_rates(&first_, &first_g_, &first_factor_)) return false;
  has_first_ = true;
  has_derivatives_ = false;
  first_.turns = state_.turns;
  stages_[0] = first_;
  factors_[0] = first_factor_;
  take_rates(0, first_g_);
  for (std::size_t i = 1; i < count(); ++i) {
    const In<double> factors = In<double>(tableau_->a[i]).first(to_signed(i));
    State<T>& stage = stages_[i];
    combine(state_.q, factors, increments_, at_.x(), stage.q);
    combine(state_.s, factors, increments_, at_.s(), stage.s);
    combine(state_.v, factors, increments_, at_.v(), stage.v);
    stage.z = stages_[i - 1].z;
    stage.t = state_.t + tableau_->alpha[i] * h_;
    turns_.follow(state_, &equations_, &stage);
    if (!solve_rates(&stage, &last_g_, &factors_[i])) return false;
    take_rates(i, last_g_);
  }
  end_ = stages_[count() - 1];
  estimate_.setZero();
  combine(estimate_, In<double>(tableau_->estimate).first(tableau_->stages), increments_, 0,
          estimate_);
  return std::isfinite(value_of(estimate_.sum()));
}

template <class T>
bool RosenbrockStep<T>::factor_stage(std::size_t i) {
  T g(0.0);
  equations_.rates(stages_[i], &residual_, &g, &derivatives_);
  return stage_matrix_.factor(derivatives_, 0.0, 0.0, 0.0);
}

template <class T>
bool RosenbrockStep<T>::attempt(double h) {
  const double hg = h * tableau_->gamma;
  h_ = h;
  if (tableau_->is_explicit()) return attempt_explicitly();
  if (!has_derivatives_) linearize_end();
  if (!stage_matrix_.factor(derivatives_, hg, hg * hg, hg)) return false;
  for (std::size_t i = 0; i < count(); ++i)
    if (!solve_stage(i)) return false;
  combine(at_, state_, In<double>(tableau_->weights).first(tableau_->stages), increments_, &end_);
  end_.t = state_.t + h;
  turns_.follow(state_, &equations_, &end_);
  return true;
}

template <class T>
double RosenbrockStep<T>::error(double relative_tolerance, double absolute_tolerance) const {
  const VectorX<T>& estimate = tableau_->is_explicit() ? estimate_ : increments_[count() - 1];
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
  add(at_.x(), state_.q, end_.q, own);
  add(at_.v(), state_.v, end_.v, of_rate);
  add(at_.s(), state_.s, end_.s, own);
  // With its own estimate the pair's error was up to ten times that of rodas4 at the same
  // tolerance, doc/decisions/0084-explicit-pair.md.
  constexpr double kPairCaution = 5.0;
  return tableau_->is_explicit() ? kPairCaution * largest : largest;
}

template <class T>
bool RosenbrockStep<T>::accept() {
  previous_ = state_;
  previous_psi_ = psi_;
  for (std::size_t j = 0; j < count(); ++j)
    psi_ += T(tableau_->weights[j]) * increments_[j][at_.psi()];
  if (tableau_->is_explicit() && layout_.m == 0) {
    first_ = end_;
    first_g_ = last_g_;
    first_factor_ = factors_[count() - 1];
    return project();
  }
  return finish();
}

template <class T>
bool RosenbrockStep<T>::resume(const State<T>& unprojected) {
  end_ = unprojected;
  return finish();
}

template <class T>
bool RosenbrockStep<T>::finish() {
  has_first_ = has_derivatives_ = false;
  T g(0.0);
  if (!tableau_->is_explicit())
    linearize_end();
  else if (layout_.m > 0)
    equations_.rates(end_, &residual_, &g, &derivatives_);
  return project();
}

// [G_a G_lambda; Phi_q 0] [delta; mu] = [0; -error], once for positions and once for velocities at
// the new positions.
template <class T>
bool RosenbrockStep<T>::project() {
  state_ = end_;
  // Without constraints the corrections are zero and the matrix is not needed.
  if (layout_.m == 0) {
    for (VectorX<T>* correction : {&position_correction_, &velocity_correction_})
      correction->setZero(layout_.columns());
    return std::isfinite(value_of(state_.q.sum() + state_.v.sum()));
  }
  if (!projection_matrix_.factor(derivatives_, 0.0, 0.0, 0.0)) return false;
  const auto correct = [this](const VectorX<T>& error, VectorX<T>* correction, VectorX<T>* target) {
    correction->setZero(layout_.columns());
    correction->segment(layout_.n, layout_.m) = -error;
    projection_matrix_.solve(correction);
    *target += correction->head(layout_.n);
  };
  equations_.constraint_errors(state_, &constraint_, &constraint_rate_);
  correct(constraint_, &position_correction_, &state_.q);
  equations_.constraint_errors(state_, &constraint_, &constraint_rate_);
  correct(constraint_rate_, &velocity_correction_, &state_.v);
  return std::isfinite(value_of(position_correction_.sum() + velocity_correction_.sum()));
}

template class RosenbrockStep<double>;
template class RosenbrockStep<std::complex<double>>;

}  // namespace codesign
