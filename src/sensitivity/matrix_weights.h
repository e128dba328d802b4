// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "equations/compiled_system.h"
#include "integration/increment.h"

namespace codesign {

/// The bilinear forms Theta = sum_k mu_k^T G_y u_k of some pairs of vectors, through which a step depends on the derivatives of the
/// equations, as the sum of the entries of G_q, G_s, G_v and G_z times weights W = sum_k mu_k u_k^T; doc/theory.md (18c).
class MatrixWeights {
 public:
  /// @param pairs the largest number of pairs.
  MatrixWeights(const CompiledSystem& system, int pairs);

  /// Sets all pairs to zero.
  void clear();
  /// Sets pair k. @param u in the order of IncrementLayout. @param mu one per row of G, then one for the integrand's row.
  void set(int k, const VectorX<double>& u, const VectorX<double>& mu);

  /// W, on the patterns of the derivatives; computed by the call.
  const ByVariable<std::vector<double>>& compute();

 private:
  void compute(const Sparsity& pattern, int first_column, std::vector<double>* weights) const;

  const CompiledSystem& system_;
  const IncrementLayout at_;
  Eigen::MatrixXd u_, mu_;  ///< a row per pair
  ByVariable<std::vector<double>> weights_;
};

}  // namespace codesign
