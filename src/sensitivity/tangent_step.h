// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <vector>

#include "assembly/extension_workspace.h"
#include "math/arrays.h"
#include "sensitivity/lane_directions.h"
#include "sensitivity/sensitivity_scale.h"
#include "sensitivity/tangent_method.h"

namespace codesign {

class Assembly;
class RosenbrockIntegrator;
struct ModeChange;

/// The exact derivative of OneStep by N parameters at once, with step sizes held fixed;
/// doc/theory.md (18).
template <int N>
class TangentStep {
 public:
  TangentStep(const CompiledSystem& system, const RosenbrockTableau& tableau);
  TangentStep(const TangentStep&) = delete;  // its methods refer to its memory
  TangentStep& operator=(const TangentStep&) = delete;

  /// Whether watched() and integral_residuals() will be called, which need the sensitivities at the
  /// beginning of the last step; from the next start() on.
  void keep_previous(bool keep) { keeps_previous_ = keep; }
  /// Starts with the initial sensitivities, (20). @param parameters all named parameters, with the
  /// directions of the N parameters in the lanes.
  /// @param assembly that found `initial`. @param mode that the steps hold, theory (17d).
  void start(const std::vector<Lanes<N>>& parameters, const Assembly& assembly,
             const State<double>& initial, const std::vector<bool>& mode = {});

  /// Computes the tangent of the stages of the step's last attempt. @param step may receive the
  /// factorization of a stage.
  void attempt(OneStep<double>* step);
  /// Scaled error of the last attempt, acceptable up to 1, in the scale of SensitivityScale.
  double error(const OneStep<double>& step, double tolerance) const;
  /// Accepts the last attempt: computes the tangent of its end and projection. To be called after
  /// OneStep::accept().
  void accept(const OneStep<double>& step);

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
    m_.y = y;
    m_.equations.equations().hold(mode);
  }

  /// What both of these do for the last jump of an integrator.
  void jump(RosenbrockIntegrator* integrator);

  /// Derivatives of the objective: psi() of its integral so far, terminal() of its terminal terms
  /// at `state`, the end of the last step.
  Eigen::Matrix<double, N, 1> psi() const { return m_.y.col(m_.at.psi()); }
  Eigen::Matrix<double, N, 1> terminal(const State<double>& state);

  /// Derivatives of the k-th watched signal, theory (21a), at `state`, a point of the dense output
  /// of the last accepted step, with z solved for by `assembly` if the signal depends on it. Only
  /// with keep_previous().
  Eigen::Matrix<double, N, 1> watched(std::size_t k, const OneStep<double>& step,
                                      const State<double>& state, bool reads_rates,
                                      const Assembly& assembly);

  /// The same for all watched signals, one column per signal.
  void all_watched(const OneStep<double>& step, const State<double>& state, bool reads_rates,
                   const Assembly& assembly, Directions<N>* signals);

  /// Derivatives of the residuals of the integrand's terms, theory (22a), at a point of the dense
  /// output, with the accelerations and multipliers of the dense output: one column per term. Only
  /// with keep_previous().
  void integral_residuals(const OneStep<double>& step, const State<double>& state,
                          Directions<N>* residuals);
  /// The same for the terminal terms at `state`, the end of the last step.
  void terminal_residuals(const State<double>& state, Directions<N>* residuals);

  /// Derivatives of the state at the end of the last accepted step, in the order of
  /// IncrementLayout.
  const Directions<N>& directions() const { return m_.y; }

 private:
  /// Takes the directions of `lanes`, which have the same values as `at`, and begins the next step
  /// there.
  void take_up(const State<double>& at, const State<Lanes<N>>& lanes);
  using Vector = typename Lanes<N>::Vector;
  TangentMethod<N>* method_of(const RosenbrockTableau& tableau) {
    if (tableau.is_explicit()) return &explicit_;
    return &rosenbrock_;
  }
  /// Sets m_.stage_y to the derivatives at `time` within the last step.
  void interpolate(const OneStep<double>& step, double time);
  /// Sets point_ to the state of the dense output with its derivatives.
  void go_to(const OneStep<double>& step, const State<double>& state, bool reads_rates,
             const Assembly& assembly);
  void differentiate_residuals(ObjectivePart part, const State<Lanes<N>>& state,
                               Directions<N>* residuals);
  /// Projects the derivatives at the end of a step, (17), as the step does its state.
  void project(const OneStep<double>& step);
  void project(const VectorX<double>& correction, const Directions<N>& errors, const SparseLu& lu,
               Out<double> target);

  TangentMemory<N> m_;
  RosenbrockTangent<N> rosenbrock_;
  ExplicitTangent<N> explicit_;
  TangentMethod<N>* method_;  ///< of the tableau
  State<double> projected_;
  Directions<N> rows_, errors_, rates_;
  /// m_.y at the start of the last accepted step; only if keeps_previous_
  Directions<N> previous_y_;
  bool keeps_previous_ = false;
  std::array<VectorX<Lanes<N>>, 2> objective_residuals_;  ///< per ObjectivePart
  ExtensionWorkspace<Lanes<N>> extension_;
  VectorX<Lanes<N>> guards_, right_;
  State<Lanes<N>> start_;  ///< with the initial sensitivities
  State<Lanes<N>> point_;  ///< a point of the dense output
  SensitivityScale<N> scale_;
};

}  // namespace codesign
