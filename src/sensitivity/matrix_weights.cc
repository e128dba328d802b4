// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "sensitivity/matrix_weights.h"

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
}

void MatrixWeights::set(int k, const VectorX<double>& u, const VectorX<double>& mu) {
  u_.row(k) = u.transpose();
  mu_.row(k) = mu.transpose();
}

void MatrixWeights::compute(const Sparsity& pattern, int first_column, std::vector<double>* weights) const {
  for (int row = 0; row < pattern.rows; ++row)
    for (int e = pattern.first(row); e < pattern.first(row + 1); ++e)
      (*weights)[static_cast<std::size_t>(e)] = mu_.col(row).dot(u_.col(first_column + pattern.column(e)));
}

const ByVariable<std::vector<double>>& MatrixWeights::compute() {
  const ByVariable<Sparsity>& patterns = system_.patterns();
  compute(patterns.position, at_.x(), &weights_.position);
  compute(patterns.velocity, at_.v(), &weights_.velocity);
  compute(patterns.rate, at_.z(), &weights_.rate);
  return weights_;
}

}  // namespace codesign
