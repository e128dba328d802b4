// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_SENSITIVITY_ADJOINT_STEP_H_
#define MECHANISM_CODESIGN_SENSITIVITY_ADJOINT_STEP_H_

#include <optional>
#include <vector>

#include "integration/rosenbrock_step.h"
#include "sensitivity/curvature.h"
#include "sparse/transposed_product.h"

namespace codesign {

/// A point where the residual G was evaluated, and the multipliers of its rows: what a parameter adds to the gradient there is mu^T G_rho.
struct WeightedPoint {
  State<double> point;
  VectorX<double> mu;  ///< one per row, that of the integrand last
};

/// One step of RosenbrockStep differentiated backwards; doc/theory.md (18b), (18c).
///
/// It carries the adjoint psi_y of the state. From one step to the one before it goes through the stages in reverse (E^T mu_i = ...), the
/// projection, and the matrices, which the step takes from the equations at its unprojected start. What parameters need is left behind.
class AdjointStep {
 public:
  AdjointStep(const CompiledSystem& system, const RosenbrockTableau& tableau);

  /// @param parameters all named parameters; `adjoint` of the state where the last step ended, as IncrementLayout lays it out, 1 for psi.
  void start(const std::vector<double>& parameters, const VectorX<double>& adjoint);

  /// Back over the stages of the step's last attempt, from where it ended to where it began.
  void reverse_stages(const RosenbrockStep<double>& step);
  /// Back over the projection onto the constraints with which the step was taken up, RosenbrockStep::resume(start).
  void reverse_projection(const State<double>& start, const RosenbrockStep<double>& step);
  /// Adds what stages and projection owe to the matrices, made at `start` too.
  void reverse_matrices(const State<double>& start, const RosenbrockStep<double>& step);

  /// psi_y where reverse_matrices() left it.
  const VectorX<double>& adjoint() const { return adjoint_; }

  // What parameters need of the present step.
  const std::vector<WeightedPoint>& stages() const { return stages_; }
  /// Phi and Phi_q v were evaluated there; rows as in G.
  const WeightedPoint& position_errors() const { return position_errors_; }
  const WeightedPoint& velocity_errors() const { return velocity_errors_; }
  /// Theta_rho, theory (18c), is the product of the derivatives of G_y by rho with these.
  const ByVariable<std::vector<double>>& matrix_weights() const { return matrix_weights_; }
  /// The same for G_t; one per row, that of the integrand last.
  const VectorX<double>& time_weights() const { return time_weights_; }

  /// Forgets the last step's: before a step that lacks stages or projection.
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
  std::optional<Curvature<4>> more_curvature_;  ///< of methods with more than six stages: the projection's
  VectorX<double> adjoint_, start_adjoint_, stage_adjoint_, sum_adjoint_, z_, direction_, time_weights_;
  std::vector<VectorX<double>> increment_adjoints_;
  std::vector<WeightedPoint> stages_;
  WeightedPoint position_errors_, velocity_errors_;
  ByVariable<std::vector<double>> matrix_weights_;
};

}  // namespace codesign

#endif  // MECHANISM_CODESIGN_SENSITIVITY_ADJOINT_STEP_H_
