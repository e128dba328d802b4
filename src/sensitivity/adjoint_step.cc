// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "sensitivity/adjoint_step.h"

#include "equations/mass_solution.h"
#include "math/arrays.h"

namespace codesign {

MatrixWeights::MatrixWeights(const CompiledSystem& system, int pairs)
    : system_(system), at_(system.layout()), u_(pairs, at_.size()), mu_(pairs, at_.z_size + 1) {
  weights_.position.resize(system.patterns().position.column_index.size());
  weights_.velocity.resize(system.patterns().velocity.column_index.size());
  weights_.rate.resize(system.patterns().rate.column_index.size());
  clear();
}

void MatrixWeights::clear() {
  u_.setZero();
  mu_.setZero();
  is_empty_ = true;
}

void MatrixWeights::set(int k, const VectorX<double>& u, const VectorX<double>& mu) {
  u_.row(k) = u.transpose();
  mu_.row(k) = mu.transpose();
  is_empty_ = false;
}

void MatrixWeights::compute(const Sparsity& pattern, int first_column,
                            std::vector<double>* weights) const {
  for (int row = 0; row < pattern.rows; ++row)
    for (int e = pattern.first(row); e < pattern.first(row + 1); ++e)
      (*weights)[to_index(e)] = mu_.col(row).dot(u_.col(first_column + pattern.column(e)));
}

const ByVariable<std::vector<double>>& MatrixWeights::compute() {
  const ByVariable<Sparsity>& patterns = system_.patterns();
  compute(patterns.position, at_.x(), &weights_.position);
  compute(patterns.velocity, at_.v(), &weights_.velocity);
  compute(patterns.rate, at_.z(), &weights_.rate);
  return weights_;
}

AdjointStep::AdjointStep(const CompiledSystem& system, const RosenbrockTableau& tableau)
    : system_(system),
      layout_(system.layout()),
      at_(layout_),
      tableau_(&tableau),
      equations_(system),
      weights_(system, RosenbrockTableau::kMaximumStages + 2),
      adjoint_(VectorX<double>::Zero(at_.size())),
      start_adjoint_(adjoint_),
      stage_adjoint_(adjoint_),
      sum_adjoint_(adjoint_),
      z_(VectorX<double>::Zero(at_.z_size)),
      direction_(adjoint_),
      time_weights_(VectorX<double>::Zero(at_.z_size + 1)),
      mu_(time_weights_),
      no_errors_(VectorX<double>::Zero(layout_.m)),
      increment_adjoints_(RosenbrockTableau::kMaximumStages, adjoint_) {}

void AdjointStep::start(const std::vector<double>& parameters, const VectorX<double>& adjoint) {
  equations_.set_design(parameters);
  adjoint_ = adjoint;
  clear();
}

void AdjointStep::clear() {
  time_weights_.setZero();
  weights_.clear();
}

void AdjointStep::add_products(const Linearization<double>& derivatives, RowRange rows,
                               const VectorX<double>& mu, VectorX<double>* adjoint) const {
  const ByVariable<Sparsity>& patterns = system_.patterns();
  const Out<double> all = *adjoint;
  add_transposed_product(patterns.position, derivatives.position, rows, 1.0, mu,
                         all.subspan(at_.x(), at_.x_size));
  add_transposed_product(patterns.velocity, derivatives.velocity, rows, 1.0, mu,
                         all.subspan(at_.v(), at_.n));
  add_transposed_product(patterns.rate, derivatives.rate, rows, 1.0, mu,
                         all.subspan(at_.z(), at_.z_size));
}

// Reverses u_psi = h gamma (g + Sigma_psi + g_y u).
void AdjointStep::reverse_integrand(std::size_t i, const OneStep<double>& step) {
  VectorX<double>&u = increment_adjoints_[i], &mu = mu_;
  mu[at_.z_size] = step.step_size() * tableau_->gamma * u[at_.psi()];
  sum_adjoint_.setZero();
  sum_adjoint_[at_.psi()] = mu[at_.z_size];
  add_products(step.derivatives(), {at_.z_size, at_.z_size + 1}, mu, &u);
}

// Reverses u_z = -E^-1 (G + G_q w_q + G_v w_v + G_s w_s); u_v = w_v + h gamma u_a, u_q = w_q + (h
// gamma)^2 u_a, u_s = w_s + h gamma u_sigma.
void AdjointStep::reverse_solve(std::size_t i, const OneStep<double>& step) {
  VectorX<double>&u = increment_adjoints_[i], &mu = mu_;
  const double hg = step.step_size() * tableau_->gamma;
  z_ = u.segment(at_.z(), at_.z_size);
  z_.head(at_.n) += hg * u.segment(at_.v(), at_.n) + hg * hg * u.segment(at_.x(), at_.n);
  z_.tail(at_.states) += hg * u.segment(at_.s(), at_.states);
  step.stage_matrix().lu().solve_transposed_rows<1>(z_);
  mu.head(at_.z_size) = -z_;
  const ByVariable<Sparsity>& patterns = system_.patterns();
  const Linearization<double>& matrices = step.derivatives();
  const RowRange rows{0, at_.z_size};
  add_transposed_product(patterns.position, matrices.position, rows, 1.0, mu,
                         Out<double>(u).subspan(at_.x(), at_.x_size));
  add_transposed_product(patterns.velocity, matrices.velocity, rows, 1.0, mu,
                         Out<double>(u).subspan(at_.v(), at_.n));
}

// Reverses w_q = h gamma (v + Sigma_q + w_v), w_v = h gamma (a + Sigma_v), w_s = h gamma (sigma +
// Sigma_s).
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

void AdjointStep::reverse_point(std::size_t i, const OneStep<double>& step) {
  const In<double> mu = mu_;
  equations_.add_transposed(EquationFunction::kResidual, step.stages()[i],
                            {mu.first(at_.z_size), mu.subspan(at_.z_size, 1), {}, {}},
                            stage_adjoint_);
  start_adjoint_ += stage_adjoint_;
  const double inverse_h = 1.0 / step.step_size();
  for (std::size_t j = 0; j < i; ++j)
    increment_adjoints_[j] +=
        tableau_->a[i][j] * stage_adjoint_ + (tableau_->c[i][j] * inverse_h) * sum_adjoint_;
}

// Reverses u_x = h (v, sigma), u_v = h a, u_psi = h g; z at the end of the step is z of the last
// stage. G = 0 gives z of each stage.
void AdjointStep::reverse_explicit_stage(std::size_t i, OneStep<double>* step) {
  const double h = step->step_size();
  const int z_size = at_.z_size;
  const VectorX<double>& u = increment_adjoints_[i];
  z_.setZero();
  if (i + 1 == count()) z_ = adjoint_.segment(at_.z(), z_size);
  z_.head(at_.n) += h * u.segment(at_.v(), at_.n);
  z_.tail(at_.states) += h * u.segment(at_.s(), at_.states);
  mu_[z_size] = h * u[at_.psi()];
  if (const auto& [pattern, values] = step->explicit_stages().stage_factor(i); pattern) {
    pattern->solve<1>(values, z_);  // symmetric; and g does not depend on z
  } else {
    step->explicit_stages().factor_stage(i);
    add_transposed_product(system_.patterns().rate, step->derivatives().rate, {z_size, z_size + 1},
                           1.0, mu_, z_);
    step->stage_matrix().lu().solve_transposed_rows<1>(z_);
  }
  mu_.head(z_size) = -z_;
  stage_adjoint_.setZero();
  stage_adjoint_.segment(at_.v(), at_.n) = h * u.segment(at_.x(), at_.n);
  const In<double> mu = mu_;
  equations_.add_transposed(EquationFunction::kResidual, step->stages()[i],
                            {mu.first(z_size), mu.subspan(z_size, 1), {}, {}}, stage_adjoint_);
  stage_adjoint_.segment(at_.z(), z_size).setZero();
  start_adjoint_ += stage_adjoint_;
  for (std::size_t j = 0; j < i; ++j) increment_adjoints_[j] += tableau_->a[i][j] * stage_adjoint_;
}

void AdjointStep::reverse_stage(std::size_t i, const OneStep<double>& step) {
  reverse_integrand(i, step);
  reverse_solve(i, step);
  reverse_elimination(i, step.step_size() * tableau_->gamma);
  reverse_point(i, step);
  weights_.set(static_cast<int>(i), step.increments()[i], mu_);
  time_weights_ += step.step_size() * tableau_->gamma_i[i] * mu_;
}

void AdjointStep::reverse_stages(OneStep<double>* step) {
  tableau_ = &step->tableau();
  const bool is_explicit = tableau_->is_explicit();
  for (std::size_t i = 0; i < count(); ++i)
    increment_adjoints_[i] = tableau_->weights[i] * adjoint_;
  start_adjoint_ = adjoint_;
  if (is_explicit) start_adjoint_.segment(at_.z(), at_.z_size).setZero();
  for (std::size_t i = count(); i-- > 0;)
    is_explicit ? reverse_explicit_stage(i, step) : reverse_stage(i, *step);
  adjoint_ = start_adjoint_;
}

// Solves the transposed system of G_z [delta; multipliers] = [0; -error] for mu_, with the adjoint
// of delta from entry `first` on.
void AdjointStep::solve_projection(const OneStep<double>& step, int first,
                                   const VectorX<double>& correction, int pair) {
  z_.setZero();
  z_.head(at_.n) = adjoint_.segment(first, at_.n);
  step.projection_matrix().lu().solve_transposed_rows<1>(z_);
  mu_.head(at_.z_size) = -z_;
  mu_[at_.z_size] = 0.0;
  direction_.segment(at_.z(), at_.z_size) = correction;
  weights_.set(RosenbrockTableau::kMaximumStages + pair, direction_, mu_);
}

void AdjointStep::reverse_projection(const State<double>& start, const OneStep<double>& step) {
  if (layout_.m == 0) return;
  const In<double> errors = In<double>(mu_).subspan(layout_.n, layout_.m);
  projected_ = start;
  projected_.q = step.state().q;
  solve_projection(step, at_.v(), step.velocity_correction(), 0);
  equations_.add_transposed(EquationFunction::kConstraintErrors, projected_,
                            {no_errors_, errors, {}, {}}, adjoint_);
  solve_projection(step, at_.x(), step.position_correction(), 1);
  equations_.add_transposed(EquationFunction::kConstraintErrors, start,
                            {errors, no_errors_, {}, {}}, adjoint_);
}

void AdjointStep::reverse_matrices(const State<double>& start) {
  if (weights_.is_empty()) return;
  const ByVariable<std::vector<double>>& weights = weights_.compute();
  equations_.add_transposed(EquationFunction::kLinearization, start,
                            {weights.position, weights.velocity, weights.rate, time_weights_},
                            adjoint_);
}

}  // namespace codesign
