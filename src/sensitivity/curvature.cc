// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "sensitivity/curvature.h"

#include <algorithm>

#include "sensitivity/lane_state.h"

namespace codesign {

template <int N>
Curvature<N>::Curvature(const CompiledSystem& system)
    : system_(system), at_(system.layout()), equations_(system), u_(at_.size()), mu_(at_.z_size + 1), products_(u_), units_(u_) {
  derivatives_.resize(system.patterns());
  state_.resize(system.layout());
}

template <int N>
void Curvature<N>::set_design(const std::vector<double>& parameters) {
  parameters_.assign(parameters.begin(), parameters.end());
  equations_.set_design(parameters_);
}

template <int N>
void Curvature<N>::clear() {
  u_.setZero();
  mu_.setZero();
}

template <int N>
void Curvature<N>::set(int k, const VectorX<double>& u, const VectorX<double>& mu) {
  u_.row(k) = u.transpose();
  mu_.row(k) = mu.transpose();
}

template <int N>
void Curvature<N>::add_transposed(const Sparsity& pattern, const std::vector<Lanes<N>>& values, int first_column) {
  for (int row = 0; row < pattern.rows; ++row)
    for (int e = pattern.first(row); e < pattern.first(row + 1); ++e)
      products_.col(first_column + pattern.column(e)) += values[static_cast<std::size_t>(e)].directions().cwiseProduct(mu_.col(row));
}

template <int N>
void Curvature<N>::add_state_gradient(const State<double>& at, VectorX<double>* adjoint) {
  load_lanes(at_, at, u_, &state_);
  equations_.linearize(state_, &derivatives_);
  products_.setZero();
  const ByVariable<Sparsity>& patterns = system_.patterns();
  add_transposed(patterns.position, derivatives_.position, at_.x());
  add_transposed(patterns.velocity, derivatives_.velocity, at_.v());
  add_transposed(patterns.rate, derivatives_.rate, at_.z());
  for (int column = 0; column < at_.psi(); ++column) (*adjoint)[column] += products_.col(column).sum();
}

template <int N>
void Curvature<N>::add_time_gradient(const State<double>& at, const VectorX<double>& weights, VectorX<double>* adjoint) {
  for (int first = 0; first < at_.psi(); first += N) {
    const int count = std::min(N, at_.psi() - first);
    units_.setZero();
    for (int k = 0; k < count; ++k) units_(k, first + k) = 1.0;
    load_lanes(at_, at, units_, &state_);
    equations_.linearize(state_, &derivatives_);
    for (Eigen::Index row = 0; row < weights.size(); ++row)
      adjoint->segment(first, count) += weights[row] * derivatives_.time[row].directions().head(count);
  }
}

template <int N>
void Curvature<N>::add_weights(const Sparsity& pattern, int first_column, std::vector<double>* weights) const {
  for (int row = 0; row < pattern.rows; ++row)
    for (int e = pattern.first(row); e < pattern.first(row + 1); ++e)
      (*weights)[static_cast<std::size_t>(e)] += mu_.col(row).dot(u_.col(first_column + pattern.column(e)));
}

template <int N>
void Curvature<N>::add_weights(ByVariable<std::vector<double>>* weights) const {
  const ByVariable<Sparsity>& patterns = system_.patterns();
  add_weights(patterns.position, at_.x(), &weights->position);
  add_weights(patterns.velocity, at_.v(), &weights->velocity);
  add_weights(patterns.rate, at_.z(), &weights->rate);
}

template class Curvature<4>;
template class Curvature<8>;

}  // namespace codesign
