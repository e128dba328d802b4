// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "sensitivity/adjoint_step.h"

#include <algorithm>

namespace codesign {
namespace {

constexpr int kPositionPair = 0, kVelocityPair = 1;  // offsets of the projection's pairs in Curvature, after the pairs of the stages

}  // namespace

AdjointStep::AdjointStep(const CompiledSystem& system, const RosenbrockTableau& tableau)
    : system_(system),
      layout_(system.layout()),
      at_(layout_),
      tableau_(tableau),
      equations_(system),
      curvature_(system),
      adjoint_(VectorX<double>::Zero(at_.size())),
      start_adjoint_(adjoint_),
      stage_adjoint_(adjoint_),
      sum_adjoint_(adjoint_),
      z_(VectorX<double>::Zero(at_.z_size)),
      direction_(adjoint_),
      time_weights_(VectorX<double>::Zero(at_.z_size + 1)),
      increment_adjoints_(static_cast<std::size_t>(tableau.stages), adjoint_),
      stages_(increment_adjoints_.size()) {
  if (tableau.stages > 6) more_curvature_.emplace(system);
  derivatives_.resize(system.patterns());
  for (WeightedPoint& stage : stages_) {
    stage.point.resize(layout_);
    stage.mu.setZero(at_.z_size + 1);
  }
  position_errors_ = velocity_errors_ = stages_.front();
  matrix_weights_.position.resize(system.patterns().position.column_index.size());
  matrix_weights_.velocity.resize(system.patterns().velocity.column_index.size());
  matrix_weights_.rate.resize(system.patterns().rate.column_index.size());
}

void AdjointStep::start(const std::vector<double>& parameters, const VectorX<double>& adjoint) {
  equations_.set_design(parameters);
  curvature_.set_design(parameters);
  if (more_curvature_) more_curvature_->set_design(parameters);
  adjoint_ = adjoint;
  clear();
}

void AdjointStep::clear() {
  time_weights_.setZero();
  curvature_.clear();
  if (more_curvature_) more_curvature_->clear();
}

void AdjointStep::add_products(const Linearization<double>& derivatives, RowRange rows, const VectorX<double>& mu,
                               VectorX<double>* adjoint) const {
  const ByVariable<Sparsity>& patterns = system_.patterns();
  const Out<double> all = *adjoint;
  add_transposed_product(patterns.position, derivatives.position, rows, 1.0, mu, all.subspan(at_.x(), at_.x_size));
  add_transposed_product(patterns.velocity, derivatives.velocity, rows, 1.0, mu, all.subspan(at_.v(), at_.n));
  add_transposed_product(patterns.rate, derivatives.rate, rows, 1.0, mu, all.subspan(at_.z(), at_.z_size));
}

// Reverses u_psi = h gamma (g + Sigma_psi + g_y u).
void AdjointStep::reverse_integrand(std::size_t i, const RosenbrockStep<double>& step) {
  VectorX<double>&u = increment_adjoints_[i], &mu = stages_[i].mu;
  mu[at_.z_size] = step.step_size() * tableau_.gamma * u[at_.psi()];
  sum_adjoint_.setZero();
  sum_adjoint_[at_.psi()] = mu[at_.z_size];
  add_products(step.derivatives(), {at_.z_size, at_.z_size + 1}, mu, &u);
}

// Reverses u_z = -E^-1 (G + G_q w_q + G_v w_v + G_s w_s); u_v = w_v + h gamma u_a, u_q = w_q + (h gamma)^2 u_a, u_s = w_s + h gamma
// u_sigma.
void AdjointStep::reverse_solve(std::size_t i, const RosenbrockStep<double>& step) {
  VectorX<double>&u = increment_adjoints_[i], &mu = stages_[i].mu;
  const double hg = step.step_size() * tableau_.gamma;
  z_ = u.segment(at_.z(), at_.z_size);
  z_.head(at_.n) += hg * u.segment(at_.v(), at_.n) + hg * hg * u.segment(at_.x(), at_.n);
  z_.tail(at_.states) += hg * u.segment(at_.s(), at_.states);
  step.stage_matrix().lu().solve_transposed_rows<1>(z_);
  mu.head(at_.z_size) = -z_;
  const ByVariable<Sparsity>& patterns = system_.patterns();
  const Linearization<double>& matrices = step.derivatives();
  const RowRange rows{0, at_.z_size};
  add_transposed_product(patterns.position, matrices.position, rows, 1.0, mu, Out<double>(u).subspan(at_.x(), at_.x_size));
  add_transposed_product(patterns.velocity, matrices.velocity, rows, 1.0, mu, Out<double>(u).subspan(at_.v(), at_.n));
}

// Reverses w_q = h gamma (v + Sigma_q + w_v), w_v = h gamma (a + Sigma_v), w_s = h gamma (sigma + Sigma_s).
void AdjointStep::reverse_elimination(std::size_t i, double hg) {
  VectorX<double>& w = increment_adjoints_[i];
  const auto w_q = w.segment(at_.x(), at_.n), w_s = w.segment(at_.s(), at_.states);
  auto w_v = w.segment(at_.v(), at_.n);
  w_v += hg * w_q;
  sum_adjoint_.segment(at_.x(), at_.n) = hg * w_q;
  sum_adjoint_.segment(at_.v(), at_.n) = hg * w_v;
  sum_adjoint_.segment(at_.s(), at_.states) = hg * w_s;
  stage_adjoint_.setZero();
  stage_adjoint_.segment(at_.v(), at_.n) = hg * w_q;
  stage_adjoint_.segment(at_.z(), at_.n) = hg * w_v;
  stage_adjoint_.segment(at_.sigma(), at_.states) = hg * w_s;
}

void AdjointStep::reverse_point(std::size_t i, const RosenbrockStep<double>& step) {
  stages_[i].point = step.stages()[i];
  equations_.linearize(stages_[i].point, &derivatives_);
  add_products(derivatives_, {0, at_.z_size + 1}, stages_[i].mu, &stage_adjoint_);
  start_adjoint_ += stage_adjoint_;
  const double inverse_h = 1.0 / step.step_size();
  for (std::size_t j = 0; j < i; ++j)
    increment_adjoints_[j] += tableau_.a[i][j] * stage_adjoint_ + (tableau_.c[i][j] * inverse_h) * sum_adjoint_;
}

void AdjointStep::reverse_stages(const RosenbrockStep<double>& step) {
  for (std::size_t i = 0; i < stages_.size(); ++i) increment_adjoints_[i] = tableau_.weights[i] * adjoint_;
  start_adjoint_ = adjoint_;
  for (std::size_t i = stages_.size(); i-- > 0;) {
    reverse_integrand(i, step);
    reverse_solve(i, step);
    reverse_elimination(i, step.step_size() * tableau_.gamma);
    reverse_point(i, step);
    add_pair(static_cast<int>(i), step.increments()[i], stages_[i].mu);
    time_weights_ += step.step_size() * tableau_.gamma_i[i] * stages_[i].mu;
  }
  adjoint_ = start_adjoint_;
}

void AdjointStep::add_pair(int k, const VectorX<double>& u, const VectorX<double>& mu) {
  if (k < 8) {
    curvature_.set(k, u, mu);
  } else {
    more_curvature_->set(k - 8, u, mu);
  }
}

// Solves the transposed system of G_z [delta; multipliers] = [0; -error] for errors->mu, with the adjoint of delta from entry `first` on.
void AdjointStep::solve_projection(const RosenbrockStep<double>& step, int first, WeightedPoint* errors) {
  z_.setZero();
  z_.head(at_.n) = adjoint_.segment(first, at_.n);
  step.projection_matrix().lu().solve_transposed_rows<1>(z_);
  errors->mu.head(at_.z_size) = -z_;
  errors->mu[at_.z_size] = 0.0;
}

// Uses that (Phi_q v)_q is half the derivative of the acceleration rows by v, theory (6).
void AdjointStep::reverse_velocity_errors(const State<double>& start, const RosenbrockStep<double>& step) {
  const RowRange constraints{layout_.n, layout_.n + layout_.m};
  const VectorX<double>& mu = velocity_errors_.mu;
  velocity_errors_.point = start;
  velocity_errors_.point.q = step.state().q;
  equations_.linearize(velocity_errors_.point, &derivatives_);
  add_transposed_product(system_.patterns().velocity, derivatives_.velocity, constraints, 0.5, mu,
                         Out<double>(adjoint_).subspan(at_.x(), at_.n));
  z_.setZero();
  add_transposed_product(system_.patterns().rate, derivatives_.rate, constraints, 1.0, mu, z_);
  adjoint_.segment(at_.v(), at_.n) += z_.head(at_.n);
}

void AdjointStep::reverse_projection(const State<double>& start, const RosenbrockStep<double>& step) {
  const int first_pair = tableau_.stages;
  solve_projection(step, at_.v(), &velocity_errors_);
  reverse_velocity_errors(start, step);
  direction_.segment(at_.z(), at_.z_size) = step.velocity_correction();
  add_pair(first_pair + kVelocityPair, direction_, velocity_errors_.mu);

  solve_projection(step, at_.x(), &position_errors_);
  position_errors_.point = start;
  z_.setZero();
  add_transposed_product(system_.patterns().rate, step.derivatives().rate, {layout_.n, layout_.n + layout_.m}, 1.0, position_errors_.mu,
                         z_);
  adjoint_.segment(at_.x(), at_.n) += z_.head(at_.n);
  direction_.segment(at_.z(), at_.z_size) = step.position_correction();
  add_pair(first_pair + kPositionPair, direction_, position_errors_.mu);
}

void AdjointStep::reverse_matrices(const State<double>& start, const RosenbrockStep<double>& step) {
  for (std::vector<double>* weights : {&matrix_weights_.position, &matrix_weights_.velocity, &matrix_weights_.rate})
    std::fill(weights->begin(), weights->end(), 0.0);
  const auto add = [&](auto* curvature) {
    curvature->add_state_gradient(start, &adjoint_);
    curvature->add_weights(&matrix_weights_);
  };
  add(&curvature_);
  if (more_curvature_) add(&*more_curvature_);
  if (!step.derivatives().time.isZero(0.0)) curvature_.add_time_gradient(start, time_weights_, &adjoint_);
}

}  // namespace codesign
