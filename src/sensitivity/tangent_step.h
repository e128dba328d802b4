// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <vector>

#include "assembly/loop_jacobian.h"
#include "equations/equations.h"
#include "integration/increment.h"
#include "integration/rosenbrock_step.h"
#include "math/arrays.h"
#include "sensitivity/lane_directions.h"
#include "sensitivity/sensitivity_scale.h"

namespace codesign {

class Assembly;
class RosenbrockIntegrator;
struct ModeChange;

/// Directional derivatives of the equations along (y', e_k) for N parameters at once, (18), by the
/// recorded equations. A prime denotes a directional derivative; only derivatives are returned, not
/// values. No allocation once warm.
template <int N>
class TangentEquations {
 public:
  explicit TangentEquations(const CompiledSystem& system);

  /// The equations with lanes, which hold the design with its directions.
  Equations<Lanes<N>>& equations() { return equations_; }

  /// G', one column per row of G, and g' in the last column. @param y directions of the state, in
  /// the order of IncrementLayout.
  void residual(const State<double>& state, const Directions<N>& y, Directions<N>* result);

  /// Computes the changes dG_q, dG_v and dG_z, integrand's row included, on
  /// CompiledSystem::patterns() with N numbers per entry, and dG_t.
  void linearize(const State<double>& state, const Directions<N>& y);
  const ByVariable<LineVector>& changes() const { return changes_; }
  const Directions<N>& time_changes() const { return time_changes_; }

  /// Phi' and (Phi_q v)'.
  void constraint_errors(const State<double>& state, const Directions<N>& y, Directions<N>* Phi,
                         Directions<N>* Phi_rate);

  /// The state with its directions in lanes, valid until the next call.
  const State<Lanes<N>>& lanes(const State<double>& state, const Directions<N>& y);

 private:
  void run(EquationFunction function, const State<double>& state, const Directions<N>& y,
           const Out<double> (&results)[4]);

  const Layout& layout_;
  const IncrementLayout at_;
  Equations<Lanes<N>> equations_;
  ByVariable<LineVector> changes_;
  Directions<N> time_changes_;
  State<Lanes<N>> state_;  ///< of lanes()
};

/// The exact derivative of RosenbrockStep by N parameters at once, with step sizes held fixed;
/// doc/theory.md (18).
///
/// The stage equation E u = -(G + G_q w_q + G_s w_s + G_v w_v) is differentiated including the
/// derivative of E:
///   E u' = -(G' + G_q w_q' + G_s w_s' + G_v w_v'
///            + (dG_q) u_q + (dG_s) u_s + (dG_v) u_v + (dG_z) u_z),
/// with dG_x the change of G_x along (y', e_k). E is solved with the factorization of the step. At
/// the stages of an explicit pair, G = 0 gives G_z z' = -G' with G' at fixed z.
template <int N>
class TangentStep {
 public:
  TangentStep(const CompiledSystem& system, const RosenbrockTableau& tableau);

  /// Whether watched() and integral_residuals() will be called, which need the sensitivities at the
  /// beginning of the last step; from the next start() on.
  void keep_previous(bool keep) { keeps_previous_ = keep; }
  /// Starts with the initial sensitivities, (20). @param parameters all named parameters, with the
  /// directions of the N parameters in the lanes.
  /// @param assembly that found `initial`. @param mode that the steps hold, theory (17d).
  void start(const std::vector<Lanes<N>>& parameters, const Assembly& assembly,
             const State<double>& initial, const std::vector<bool>& mode = {});

  /// Computes the tangent of the stages of the step's last attempt. @param step of an explicit pair
  /// receives the factorization of a stage.
  void attempt(RosenbrockStep<double>* step);
  /// Scaled error of the last attempt, acceptable up to 1, in the scale of SensitivityScale.
  double error(const RosenbrockStep<double>& step, double tolerance) const;
  /// Accepts the last attempt: computes the tangent of its end and projection. To be called after
  /// RosenbrockStep::accept().
  void accept(const RosenbrockStep<double>& step);

  /// Carries the sensitivities over a jump of the step's integrator: the derivative of (q, v, g(q,
  /// v, s)) and of the rates that belong to it. @param assembly that solved for the rates of
  /// `behind`. @param behind the state after the jump, where the step begins again.
  /// @param mode that the equations hold from there on.
  void jump(const std::vector<ControlEvent>& events, const State<double>& before,
            const State<double>& behind, const Assembly& assembly,
            const std::vector<bool>& mode = {});

  /// Carries the sensitivities over an instant that a guard s determines, theory (18g): with tau' =
  /// -s'/(s_t + s_x f-) they grow by (f- - f+) tau'. jump() with the mode after it follows.
  void cross(const ModeChange& change);

  /// tau' of theory (18g): the derivatives of the time at which a guard is zero, at the end of the
  /// last step. @param rate s_t + s_x f of the guard.
  Eigen::Matrix<double, N, 1> guard_time(int guard, double rate, const State<double>& end);

  /// Takes back what both of these did. @param y directions() before. @param mode before.
  void go_back(const Directions<N>& y, const std::vector<bool>& mode) {
    y_ = y;
    equations_.equations().hold(mode);
  }

  /// What both of these do for the last jump of an integrator.
  void jump(RosenbrockIntegrator* integrator);

  /// Derivatives of the objective: psi() of its integral so far, terminal() of its terminal terms
  /// at `state`, the end of the last step.
  Eigen::Matrix<double, N, 1> psi() const { return y_.col(at_.psi()); }
  Eigen::Matrix<double, N, 1> terminal(const State<double>& state);

  /// Derivatives of the k-th watched signal, theory (21a), at `state`, a point of the dense output
  /// of the last accepted step, with z solved for by `assembly` if the signal depends on it. Only
  /// with keep_previous().
  Eigen::Matrix<double, N, 1> watched(std::size_t k, const RosenbrockStep<double>& step,
                                      const State<double>& state, bool reads_rates,
                                      const Assembly& assembly);

  /// The same for all watched signals, one column per signal.
  void all_watched(const RosenbrockStep<double>& step, const State<double>& state, bool reads_rates,
                   const Assembly& assembly, Directions<N>* signals);

  /// Derivatives of the residuals of the integrand's terms, theory (22a), at a point of the dense
  /// output, with the accelerations and multipliers of the dense output: one column per term. Only
  /// with keep_previous().
  void integral_residuals(const RosenbrockStep<double>& step, const State<double>& state,
                          Directions<N>* residuals);
  /// The same for the terminal terms at `state`, the end of the last step.
  void terminal_residuals(const State<double>& state, Directions<N>* residuals);

  /// Derivatives of the state at the end of the last accepted step, in the order of
  /// IncrementLayout.
  const Directions<N>& directions() const { return y_; }

 private:
  /// Takes the directions of `lanes`, which have the same values as `at`, and begins the next step
  /// there.
  void take_up(const State<double>& at, const State<Lanes<N>>& lanes);
  using Vector = typename Lanes<N>::Vector;
  /// to = from + sum of factors[j] u'_j, for the components of u' from the `first` on.
  void combine(In<double> from, In<double> factors, int first, Out<double> to) const;
  /// Handles `together` stages at a time; `together` divides the number of stages.
  template <std::size_t together>
  void change_matrices(const RosenbrockStep<double>& step);
  std::size_t count() const { return to_index(tableau_->stages); }
  void linearize(const State<double>& state);
  void explicit_stage(std::size_t i, RosenbrockStep<double>* step);
  void stage_start(std::size_t i, double h);
  void stage_tangent(std::size_t i, const RosenbrockStep<double>& step);
  /// Sets stage_y_ to the derivatives at `time` within the last step.
  void interpolate(const RosenbrockStep<double>& step, double time);
  /// Sets point_ to the state of the dense output with its derivatives.
  void go_to(const RosenbrockStep<double>& step, const State<double>& state, bool reads_rates,
             const Assembly& assembly);
  void differentiate_residuals(ObjectivePart part, const State<Lanes<N>>& state,
                               Directions<N>* residuals);
  /// Projects the derivatives at the end of a step, (17), as the step does its state.
  void project(const RosenbrockStep<double>& step);
  void project(const VectorX<double>& correction, const Directions<N>& errors, const SparseLu& lu,
               Out<double> target);

  const CompiledSystem& system_;
  const Layout& layout_;
  const IncrementLayout at_;
  const RosenbrockTableau* tableau_;  ///< of the last attempt
  TangentEquations<N> equations_;
  State<double> projected_;
  Directions<N> y_, stage_y_, residual_, rows_, errors_, rates_, estimate_;
  /// y_ at the start of the last accepted step; only if keeps_previous_
  Directions<N> previous_y_;
  bool keeps_previous_ = false;
  /// whether the changes of the matrices are those with which the next step begins
  bool has_changes_ = false;
  std::array<VectorX<Lanes<N>>, 2> objective_residuals_;  ///< per ObjectivePart
  ExtensionWorkspace<Lanes<N>> extension_;
  VectorX<Lanes<N>> guards_, right_;
  State<Lanes<N>> start_;                      ///< with the initial sensitivities
  State<Lanes<N>> point_;                      ///< a point of the dense output
  std::vector<Directions<N>> stages_;          ///< u' of each stage
  std::vector<Directions<N>> matrix_changes_;  ///< dG u of each stage, row by row
  SensitivityScale<N> scale_;
};

}  // namespace codesign
