// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_SENSITIVITY_IDAS_TANGENT_H_
#define MECHANISM_CODESIGN_SENSITIVITY_IDAS_TANGENT_H_

#include <vector>

#include "equations/iteration_matrix.h"
#include "integration/idas_integrator.h"
#include "sensitivity/lane_groups.h"

namespace codesign {

/// The sensitivity equations that IDAS integrates; doc/theory.md (27):
///   0 = G_q q_rho + G_v v_rho + G_s s_rho + G_z z_rho + G_rho, and g's the same; rows of constraints stabilized as IDAS's residual.
/// By states the derivatives are the hand-written ones, by parameters automatic: once per point, whatever the corrector then asks for.
class IdasTangent final : public IdasSensitivities {
 public:
  explicit IdasTangent(const CompiledSystem& system);

  int count() const override { return static_cast<int>(partial_.cols()); }
  void start(const std::vector<double>& parameters, const State<double>& initial, Integrator* integrator,
             std::vector<State<double>>* sensitivities, std::vector<double>* scales) override;
  void linearize(const State<double>& state, double kappa, Equations<double>* equations) override;
  void derivative(int k, const State<double>& direction, VectorX<double>* result) override;
  bool project(const State<double>& state, Equations<double>* equations, std::vector<State<double>>* directions) override;

  /// w_rho of the terminal terms at a consistent state; not a number where G_z is singular. @param directions (q, v, s)_rho per parameter;
  /// their z is solved for.
  void terminal(const State<double>& state, Equations<double>* equations, std::vector<State<double>>* directions,
                Eigen::VectorXd* gradient);

 private:
  template <int N>
  struct Group {
    using Scalar = Lanes<N>;
    Group(const CompiledSystem& system, LaneRange<N> lanes);
    /// Sets values, and the first-order parts of this group's parameters to their columns in `directions`, or to zero without.
    void load(const State<double>& at, const std::vector<State<double>>* directions);

    LaneRange<N> range;
    Equations<Scalar> equations;
    State<Scalar> state;
    VectorX<Scalar> G, Phi, Phi_rate;
  };

  /// Makes the derivatives at a state present, without stabilization, and factors G_z. False if it is singular.
  bool factor(const State<double>& state, Equations<double>* equations);
  /// Solves for z_rho of directions whose (q, v, s)_rho are given.
  void solve_rates(std::vector<State<double>>* directions);
  /// Adds the least change that satisfies the constraints' derivatives to q_rho, or to v_rho.
  void correct(const State<double>& state, VectorX<double> State<double>::*part, std::vector<State<double>>* directions);

  const CompiledSystem& system_;
  LaneGroups<Group> groups_;
  Linearization<double> derivatives_;
  Eigen::MatrixXd partial_;  ///< (G, g)_rho at the present point
  IterationMatrix matrix_;
  VectorX<double> dG_, stabilized_;
  State<double> stabilized_direction_;
  double kappa_ = 0.0;
};

}  // namespace codesign

#endif  // MECHANISM_CODESIGN_SENSITIVITY_IDAS_TANGENT_H_
