// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_SENSITIVITY_ADJOINT_STEP_H_
#define MECHANISM_CODESIGN_SENSITIVITY_ADJOINT_STEP_H_

#include <optional>
#include <vector>

#include "integration/rosenbrock_step.h"
#include "sensitivity/curvature.h"
#include "sparse/transposed_product.h"

namespace codesign {

/// A state at which G was evaluated, and the multipliers mu of its rows, theory (18b). The evaluation contributes mu^T G_rho to the
/// gradient.
struct WeightedPoint {
  State<double> point;
  VectorX<double> mu;  ///< one per row of G, then one for the integrand's row
};

/// One step of RosenbrockStep differentiated backwards; doc/theory.md (18b), (18c).
///
/// It holds the adjoint psi_y of the state. Each step is reversed in three calls: the stages in reverse order (E^T mu_i = ...), the
/// projection at its start, and the matrices, which are derivatives of the equations at the unprojected start. The accessors below then
/// give the multipliers that ParameterLanes needs for the explicit dependence on parameters.
class AdjointStep {
 public:
  AdjointStep(const CompiledSystem& system, const RosenbrockTableau& tableau);

  /// @param parameters all named parameters (Study::parameters order).
  /// @param adjoint psi_y at the end of the last step, in the order of IncrementLayout, with 1 for psi.
  void start(const std::vector<double>& parameters, const VectorX<double>& adjoint);

  /// Reverses the stages of the step's last attempt: psi_y at its end becomes psi_y at its start.
  void reverse_stages(const RosenbrockStep<double>& step);
  /// Reverses the projection of `start`, the unprojected start of the step, as made by RosenbrockStep::resume(start).
  void reverse_projection(const State<double>& start, const RosenbrockStep<double>& step);
  /// Adds Theta_y of (18c): the dependence of stages and projection on `start` through the matrices evaluated there.
  void reverse_matrices(const State<double>& start, const RosenbrockStep<double>& step);

  /// psi_y at `start` after reverse_matrices(), in the order of IncrementLayout.
  const VectorX<double>& adjoint() const { return adjoint_; }

  // The multipliers of the last step, for the gradient by parameters, (18d).
  const std::vector<WeightedPoint>& stages() const { return stages_; }
  /// The points at which the projection evaluated Phi and Phi_q v; their multipliers are in the acceleration rows of G.
  const WeightedPoint& position_errors() const { return position_errors_; }
  const WeightedPoint& velocity_errors() const { return velocity_errors_; }
  /// Weights on the entries of G_q, G_v and G_z: Theta of (18c) is the sum of entries times weights, Theta_rho the same with d/d rho.
  const ByVariable<std::vector<double>>& matrix_weights() const { return matrix_weights_; }
  /// The same for G_t; one per row of G, then one for the integrand's row.
  const VectorX<double>& time_weights() const { return time_weights_; }

  /// Resets the contributions of the previous step. Needed before a step without stages (the last point) or without projection (the start).
  void clear();

 private:
  void reverse_integrand(std::size_t i, const RosenbrockStep<double>& step);
  void reverse_solve(std::size_t i, const RosenbrockStep<double>& step);
  void reverse_elimination(std::size_t i, double hg);
  void reverse_point(std::size_t i, const RosenbrockStep<double>& step);
  void solve_projection(const RosenbrockStep<double>& step, int first, WeightedPoint* errors);
  void reverse_velocity_errors(const State<double>& start, const RosenbrockStep<double>& step);
  void add_products(const Linearization<double>& derivatives, RowRange rows, const VectorX<double>& mu, VectorX<double>* adjoint) const;
  void add_pair(int k, const VectorX<double>& u, const VectorX<double>& mu);

  const CompiledSystem& system_;
  const Layout& layout_;
  const IncrementLayout at_;
  const RosenbrockTableau& tableau_;
  Equations<double> equations_;
  Linearization<double> derivatives_;
  Curvature<8> curvature_;
  std::optional<Curvature<4>> more_curvature_;  ///< for methods with more than six stages: the projection's pairs
  VectorX<double> adjoint_, start_adjoint_, stage_adjoint_, sum_adjoint_, z_, direction_, time_weights_;
  std::vector<VectorX<double>> increment_adjoints_;
  std::vector<WeightedPoint> stages_;
  WeightedPoint position_errors_, velocity_errors_;
  ByVariable<std::vector<double>> matrix_weights_;
};

}  // namespace codesign

#endif  // MECHANISM_CODESIGN_SENSITIVITY_ADJOINT_STEP_H_
