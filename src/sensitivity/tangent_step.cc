// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "mechanism_codesign/sensitivity/tangent_step.h"

#include <algorithm>
#include <cmath>

#include "mechanism_codesign/dynamics/row_product.h"

namespace codesign {

template <int N>
TangentStep<N>::TangentStep(const System& system, const RosenbrockTableau& tableau)
    : system_(system),
      layout_(system.layout()),
      at_(layout_),
      tableau_(tableau),
      equations_(system),
      y_(Directions<N>::Zero(N, at_.size())),
      stage_y_(y_),
      sum_(y_),
      rows_(Directions<N>::Zero(N, layout_.columns() + 1)),
      shift_(VectorX<double>::Zero(at_.size())),
      stages_(static_cast<std::size_t>(tableau.stages), y_) {
  derivatives_.resize(system.patterns());
  state_.resize(layout_);
  stage_.resize(layout_);
  projected_.resize(layout_);
}

template <int N>
void TangentStep<N>::load_lanes(const State<double>& values, const Directions<N>& directions) {
  const auto load = [&directions](const VectorX<double>& value, int first, VectorX<Lanes<N>>* lanes) {
    for (Eigen::Index k = 0; k < value.size(); ++k) {
      (*lanes)[k].a = value[k];
      (*lanes)[k].directions() = directions.col(first + k);
    }
  };
  state_.t = values.t;
  load(values.q, at_.x(), &state_.q);
  load(values.s, at_.s(), &state_.s);
  load(values.v, at_.v(), &state_.v);
  load(values.z, at_.z(), &state_.z);
}

template <int N>
void TangentStep<N>::start(const std::vector<Lanes<N>>& parameters, const Assembly& assembly, const State<double>& initial,
                           const RosenbrockStep<double>& step) {
  equations_.set_design(parameters);
  equations_.turn_references() = step.equations().turn_references();
  assembly.extend(parameters, initial, &equations_, &state_);
  const auto take = [this](const VectorX<Lanes<N>>& lanes, int first) {
    for (Eigen::Index k = 0; k < lanes.size(); ++k) y_.col(first + k) = lanes[k].directions();
  };
  y_.setZero();
  take(state_.q, at_.x());
  take(state_.s, at_.s());
  take(state_.v, at_.v());
  take(state_.z, at_.z());
  equations_.linearize(state_, &derivatives_);
  largest_x_.setZero();
  largest_v_.setZero();
  measure();
}

template <int N>
void TangentStep<N>::stage_state(std::size_t i, const RosenbrockStep<double>& step) {
  const auto &a = tableau_.a[i], &c = tableau_.c[i];
  const double inverse_h = 1.0 / step.step_size();
  // One pass over the stages: each is read once for both sums.
  for (int column = 0; column < at_.size(); ++column) {
    Vector y = vector_at(&y_, column), sum{};
    for (std::size_t j = 0; j < i; ++j) {
      const Vector& u = vector_at(&stages_[j], column);
      y += a[j] * u;
      sum += (c[j] * inverse_h) * u;
    }
    vector_at(&stage_y_, column) = y;
    vector_at(&sum_, column) = sum;
  }
  shift_.setZero();
  for (std::size_t j = 0; j < i; ++j) shift_ += a[j] * step.increments()[j];
  stage_ = step.state();
  add_increment(at_, shift_, &stage_);
  stage_.t += tableau_.alpha[i] * step.step_size();
  load_lanes(stage_, stage_y_);
}

template <int N>
void TangentStep<N>::stage_rows(std::size_t i, const RosenbrockStep<double>& step) {
  const ByVariable<Sparsity>& patterns = system_.patterns();
  const Linearization<double>& matrices = step.derivatives();
  const VectorX<double>& u = step.increments()[i];
  const double *const x = u.data(), *const v = x + at_.v(), *const z = x + at_.z();
  const double *const dx = stages_[i].data(), *const dv = dx + N * at_.v();
  const double time_shift = step.step_size() * tableau_.gamma_i[i];
  for (int row = 0; row <= at_.z_size; ++row) {
    const Lanes<N>& own = row < at_.z_size ? residual_[row] : g_;
    Vector sum = own.v + time_shift * derivatives_.time[row].v;
    if (row < at_.z_size) {
      add_row_product<N>(patterns.position, matrices.position, row, dx, &sum);
      add_row_product<N>(patterns.velocity, matrices.velocity, row, dv, &sum);
    }
    add_row_tangent<N>(patterns.position, derivatives_.position, row, x, &sum);
    add_row_tangent<N>(patterns.velocity, derivatives_.velocity, row, v, &sum);
    add_row_tangent<N>(patterns.rate, derivatives_.rate, row, z, &sum);
    vector_at(&rows_, row) = row < at_.z_size ? -sum : sum;
  }
}

template <int N>
void TangentStep<N>::stage_tangent(std::size_t i, const RosenbrockStep<double>& step) {
  const double hg = step.step_size() * tableau_.gamma;
  stage_state(i, step);
  equations_.residual(state_, &residual_, &g_);
  Directions<N>& u = stages_[i];
  auto u_q = u.middleCols(at_.x(), at_.n), u_s = u.middleCols(at_.s(), at_.states), u_v = u.middleCols(at_.v(), at_.n);
  u_v = hg * (stage_y_.middleCols(at_.z(), at_.n) + sum_.middleCols(at_.v(), at_.n));
  u_q = hg * (stage_y_.middleCols(at_.v(), at_.n) + sum_.middleCols(at_.x(), at_.n) + u_v);
  u_s = hg * (stage_y_.middleCols(at_.sigma(), at_.states) + sum_.middleCols(at_.s(), at_.states));
  stage_rows(i, step);
  step.stage_matrix().lu().template solve_rows<N>(rows_.data());
  u.middleCols(at_.z(), at_.z_size) = rows_.leftCols(at_.z_size);
  const auto u_a = u.middleCols(at_.z(), at_.n);
  u_v += hg * u_a;
  u_q += hg * hg * u_a;
  u_s += hg * u.middleCols(at_.sigma(), at_.states);
  const ByVariable<Sparsity>& patterns = system_.patterns();
  const Linearization<double>& matrices = step.derivatives();
  Vector psi = vector_at(&rows_, at_.z_size) + vector_at(&sum_, at_.psi());
  add_row_product<N>(patterns.position, matrices.position, at_.z_size, u.data(), &psi);
  add_row_product<N>(patterns.velocity, matrices.velocity, at_.z_size, u.data() + N * at_.v(), &psi);
  add_row_product<N>(patterns.rate, matrices.rate, at_.z_size, u.data() + N * at_.z(), &psi);
  vector_at(&u, at_.psi()) = hg * psi;
}

template <int N>
void TangentStep<N>::attempt(const RosenbrockStep<double>& step) {
  equations_.turn_references() = step.equations().turn_references();
  for (std::size_t i = 0; i < stages_.size(); ++i) stage_tangent(i, step);
}

template <int N>
double TangentStep<N>::error(double relative_tolerance) const {
  const Directions<N>& u = stages_.back();
  const auto ratio = [](const auto& change, const Eigen::Array<double, N, 1>& size) {
    const Eigen::Array<double, N, 1> squares = change.rowwise().squaredNorm().array();
    // A parameter that moves nothing has no error.
    return (size > 0.0).select(squares / size, 0.0).maxCoeff();
  };
  const double largest = std::max(ratio(u.leftCols(at_.x_size), largest_x_), ratio(u.middleCols(at_.v(), at_.n), largest_v_));
  return std::sqrt(largest) / relative_tolerance;
}

template <int N>
void TangentStep<N>::measure() {
  largest_x_ = largest_x_.max(y_.leftCols(at_.x_size).rowwise().squaredNorm().array());
  largest_v_ = largest_v_.max(y_.middleCols(at_.v(), at_.n).rowwise().squaredNorm().array());
}

// Differentiates [G_a G_lambda; Phi_q 0] [delta; mu] = [0; -error].
template <int N>
void TangentStep<N>::project(const VectorX<double>& correction, const VectorX<Lanes<N>>& errors, const SparseLu& lu, double* target) {
  for (int row = 0; row < at_.z_size; ++row) {
    Vector sum{};
    add_row_tangent<N>(system_.patterns().rate, derivatives_.rate, row, correction.data(), &sum);
    const int constraint = row - layout_.n;
    if (constraint >= 0 && constraint < layout_.m) sum += errors[constraint].v;
    vector_at(&rows_, row) = -sum;
  }
  lu.template solve_rows<N>(rows_.data());
  for (int k = 0; k < N * layout_.n; ++k) target[k] += rows_.data()[k];
}

template <int N>
void TangentStep<N>::accept(const RosenbrockStep<double>& step) {
  for (std::size_t j = 0; j < stages_.size(); ++j) y_ += tableau_.weights[j] * stages_[j];
  const SparseLu& lu = step.projection_matrix().lu();
  load_lanes(step.unprojected(), y_);
  equations_.linearize(state_, &derivatives_);
  equations_.constraint_errors(state_.q, state_.v, &errors_, &rates_);
  project(step.position_correction(), errors_, lu, y_.data() + N * at_.x());
  projected_ = step.unprojected();
  projected_.q = step.state().q;
  load_lanes(projected_, y_);
  equations_.constraint_errors(state_.q, state_.v, &errors_, &rates_);
  project(step.velocity_correction(), rates_, lu, y_.data() + N * at_.v());
  measure();
}

template <int N>
Eigen::Matrix<double, N, 1> TangentStep<N>::terminal(const State<double>& state) {
  load_lanes(state, y_);
  return equations_.terminal(state_, nullptr).directions();
}

template class TangentStep<4>;
template class TangentStep<8>;

}  // namespace codesign
