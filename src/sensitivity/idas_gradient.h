// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <memory>
#include <vector>

#include "assembly/assembly.h"
#include "equations/iteration_matrix.h"
#include "integration/idas_integrator.h"
#include "sensitivity/end_motion.h"
#include "sensitivity/gradient_engine.h"
#include "sensitivity/lane_directions.h"
#include "sensitivity/residual_rows.h"
#include "sensitivity/signal_watch.h"

namespace codesign {

/// The sensitivity equations that IDAS integrates; doc/theory.md (27):
///   0 = G_q q_rho + G_v v_rho + G_s s_rho + G_z z_rho + G_rho,
/// and the same for g; constraint rows are stabilized as in IdasEquations.
/// Derivatives by the state are analytic, derivatives by parameters come from lanes. Both are
/// computed once per point, and every call of the corrector at this point uses them.
class IdasTangent final : public IdasSensitivities {
 public:
  explicit IdasTangent(const CompiledSystem& system);

  int count() const override { return static_cast<int>(partial_.cols()); }
  void start(const std::vector<double>& parameters, const State<double>& initial,
             Integrator* integrator, std::vector<State<double>>* sensitivities,
             std::vector<double>* scales) override;
  const Linearization<double>& linearize(const State<double>& state, double kappa,
                                         Equations<double>* equations) override;
  void derivative(int k, const State<double>& direction, VectorX<double>* result) override;
  bool jump(const std::vector<ControlEvent>& events, const State<double>& before,
            const State<double>& behind, Equations<double>* equations,
            std::vector<State<double>>* directions) override;
  bool project(const State<double>& state, Equations<double>* equations,
               std::vector<State<double>>* directions) override;

  /// Sets `gradient` (p entries) to the total derivative of the terminal terms w by rho at a
  /// consistent state; NaN if G_z is singular. @param directions (q, v, s)_rho per parameter; their
  /// z is solved for.
  void terminal(const State<double>& state, Equations<double>* equations,
                std::vector<State<double>>* directions, Eigen::VectorXd* gradient);
  /// The same for the k-th watched signal, theory (21a).
  void watched(std::size_t k, const State<double>& state, Equations<double>* equations,
               std::vector<State<double>>* directions, Eigen::VectorXd* gradient);
  /// The same for the residuals of the objective, theory (22a): p rows, one column per term. NaN if
  /// G_z is singular.
  void residuals(ObjectivePart part, const State<double>& state, Equations<double>* equations,
                 std::vector<State<double>>* directions, Eigen::MatrixXd* rows);

 private:
  template <int N>
  struct Group {
    using Scalar = Lanes<N>;
    Group(const CompiledSystem& system, LaneRange<N> lanes);
    /// Sets the lanes of `state`: the values from `at`, the first-order parts from the `directions`
    /// of this group's parameters, or zero for nullptr.
    void load(const State<double>& at, const std::vector<State<double>>* directions);
    /// Copies the k-th lane of `state` to a direction.
    void take(int k, State<double>* direction) const;

    LaneRange<N> range;
    Equations<Scalar> equations;
    std::vector<Scalar> parameters;  ///< with the directions of `range`
    State<Scalar> state;
    ExtensionWorkspace<Scalar> extension;
    VectorX<Scalar> G, Phi, Phi_rate;
    std::array<VectorX<Scalar>, 2> residuals;  ///< per ObjectivePart
  };

  /// The total derivative of a function of a state with lanes, read from a group's equations.
  template <class Function>
  void differentiate(const Function& function, const State<double>& state,
                     Equations<double>* equations, std::vector<State<double>>* directions,
                     Eigen::VectorXd* gradient);
  /// Evaluates the derivatives at a state, without stabilization, and factors G_z. False if it is
  /// singular.
  bool factor(const State<double>& state, Equations<double>* equations);
  /// Solves for z_rho of directions whose (q, v, s)_rho are given.
  void solve_rates(std::vector<State<double>>* directions);
  /// Corrects q_rho, or v_rho, as in the projection (17), so that they satisfy the derivative of
  /// Phi, or of Phi_q v.
  void correct(const State<double>& state, VectorX<double> State<double>::*part,
               std::vector<State<double>>* directions);

  const CompiledSystem& system_;
  LaneGroups<Group> groups_;
  Linearization<double> derivatives_;
  Eigen::MatrixXd partial_;  ///< (G, g)_rho at the last linearize(), one column per parameter
  IterationMatrix matrix_;
  VectorX<double> dG_, stabilized_;
  State<double> stabilized_direction_;
  double kappa_ = 0.0;
};

/// Gradient by the staggered forward sensitivities of IDAS; doc/theory.md (27).
class IdasGradient final : public GradientEngine {
 public:
  explicit IdasGradient(const CompiledSystem& system);

  Status start(const std::vector<double>& parameters, Derivatives derivatives) override;
  Status advance(double limit) override;
  const Integrator& integrator() const override { return integrator_; }
  double objective() override;
  void gradient(Eigen::VectorXd* gradient) override;
  void jacobian_root(Eigen::MatrixXd* root) override;
  const Extremes& extremes() const override { return watch_.extremes(); }
  const Statistics& statistics() const override { return integrator_.statistics(); }
  Warnings warnings() const override { return integrator_.warnings(); }
  void obey(const std::atomic<bool>* cancel) override { integrator_.obey(cancel); }

 private:
  /// The state at the end of the last step with accelerations and multipliers solved from G = 0, so
  /// that terminal terms do not depend on the derivatives of BDF.
  const State<double>& consistent_state();
  Status start_watches(bool with_gradient);
  /// Sets directions_ to the directions at the end of the last step.
  void take_directions();

  const CompiledSystem& system_;
  IdasIntegrator integrator_;
  std::unique_ptr<IdasTangent> tangent_;
  State<double> end_;
  std::vector<State<double>> directions_;
  SignalWatch watch_;
  ResidualRows residuals_;
  EndMotion end_motion_;
  bool with_root_ = false;
};

}  // namespace codesign
