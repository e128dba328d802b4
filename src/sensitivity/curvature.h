// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_SENSITIVITY_CURVATURE_H_
#define MECHANISM_CODESIGN_SENSITIVITY_CURVATURE_H_

#include <vector>

#include "integration/increment.h"
#include "sensitivity/tangent_step.h"

namespace codesign {

/// The bilinear forms Theta = sum_k mu_k^T G_y(y, rho) u_k of N pairs of vectors, through which a step depends on the derivatives of the
/// equations; doc/theory.md (18c).
///
/// Because second derivatives are symmetric, dTheta/dy = sum_k (dG_y[u_k])^T mu_k, where lane k holds the change of G_y along u_k.
template <int N>
class Curvature {
 public:
  explicit Curvature(const CompiledSystem& system);

  /// @param parameters all named parameters.
  void set_design(const std::vector<double>& parameters);
  /// Sets all pairs to zero.
  void clear();
  /// Sets pair k. @param u in the order of IncrementLayout. @param mu one per row of G, then one for the integrand's row.
  void set(int k, const VectorX<double>& u, const VectorX<double>& mu);

  /// adjoint += dTheta/dy at a state.
  void add_state_gradient(const State<double>& at, VectorX<double>* adjoint);

  /// adjoint += d/dy of the sum of weights[row] G_t[row], the integrand's row last. Differentiates along one unit vector per coordinate,
  /// since time has no lane.
  void add_time_gradient(const State<double>& at, const VectorX<double>& weights, VectorX<double>* adjoint);

  /// weights += sum_k mu_k[row] u_k[column] for each entry of the patterns, so that Theta is the sum of entries times weights.
  void add_weights(ByVariable<std::vector<double>>* weights) const;

 private:
  void add_transposed(const Sparsity& pattern, const std::vector<Lanes<N>>& values, int first_column);
  void add_weights(const Sparsity& pattern, int first_column, std::vector<double>* weights) const;

  const CompiledSystem& system_;
  const IncrementLayout at_;
  std::vector<Lanes<N>> parameters_;  ///< workspace of set_design()
  Equations<Lanes<N>> equations_;
  Linearization<Lanes<N>> derivatives_;
  State<Lanes<N>> state_;
  Directions<N> u_, mu_, products_, units_;
};

}  // namespace codesign

#endif  // MECHANISM_CODESIGN_SENSITIVITY_CURVATURE_H_
