// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_SENSITIVITY_CURVATURE_H_
#define MECHANISM_CODESIGN_SENSITIVITY_CURVATURE_H_

#include <vector>

#include "integration/increment.h"
#include "sensitivity/tangent_step.h"

namespace codesign {

/// The bilinear forms Theta = sum_k mu_k^T G_y(y, rho) u_k of N pairs of vectors, which a step contains because its matrices are the
/// equations' own derivatives; doc/theory.md (18c).
///
/// Second derivatives are symmetric: dTheta/dy = sum_k (dG_y[u_k])^T mu_k, with the change of G_y along u_k in lane k.
template <int N>
class Curvature {
 public:
  explicit Curvature(const CompiledSystem& system);

  /// @param parameters all named parameters.
  void set_design(const std::vector<double>& parameters);
  void clear();
  /// Sets pair k. @param u as IncrementLayout lays it out; @param mu one per row, that of the integrand last.
  void set(int k, const VectorX<double>& u, const VectorX<double>& mu);

  /// adjoint += dTheta/dy at a point. @param equations the design's, for its turn references.
  void add_state_gradient(const State<double>& at, const Equations<double>& equations, VectorX<double>* adjoint);

  /// adjoint += d/dy sum of weights[row] G_t[row], the integrand's row last; by units of all coordinates, as long as time is no lane.
  void add_time_gradient(const State<double>& at, const VectorX<double>& weights, VectorX<double>* adjoint);

  /// weights += sum_k mu_k[row] u_k[column] for each entry of the patterns: Theta is the product of entries and weights.
  void add_weights(ByVariable<std::vector<double>>* weights) const;

 private:
  void add_transposed(const Sparsity& pattern, const std::vector<Lanes<N>>& values, int first_column);
  void add_weights(const Sparsity& pattern, int first_column, std::vector<double>* weights) const;

  const CompiledSystem& system_;
  const IncrementLayout at_;
  Equations<Lanes<N>> equations_;
  Linearization<Lanes<N>> derivatives_;
  State<Lanes<N>> state_;
  Directions<N> u_, mu_, products_, units_;
};

}  // namespace codesign

#endif  // MECHANISM_CODESIGN_SENSITIVITY_CURVATURE_H_
