// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <vector>

#include "assembly/assembly.h"
#include "control/control_clock.h"
#include "integration/continuation.h"
#include "integration/idas_equations.h"
#include "integration/idas_handles.h"
#include "integration/integrator.h"
#include "integration/run_ends.h"
#include "integration/run_watch.h"
#include "integration/singularity_watch.h"
#include "integration/stage_matrix.h"
#include "integration/step_control.h"

namespace codesign {

/// Variable-order BDF by SUNDIALS IDAS on q' = v, 0 = G(q, v, s; v', lambda, s'), psi' = g;
/// doc/theory.md (25)-(27).
///
/// The unknowns are (q, v, s, lambda); a and sigma are the derivatives of v and s. Newton's linear
/// systems are reduced to the size of (a, lambda, sigma). lambda is not part of the error test. A
/// multistep method cannot be projected after each step without a restart at order one, so the
/// constraint rows are stabilized instead; where the drift (17a) grows too large nevertheless, (q,
/// v) and the sensitivities are projected and the method restarts. A failure of IDAS is returned as
/// a Status with time and cause.
class IdasIntegrator final : public Integrator {
 public:
  explicit IdasIntegrator(const CompiledSystem& system);

  /// Sets the sensitivities to integrate from the next start() on, by the staggered corrector and
  /// with error test; nullptr for none. `sensitivities` must outlive the integration.
  void carry(IdasSensitivities* sensitivities);

  Status start(const std::vector<double>& parameters) override;
  Status advance(double limit) override;
  Status go_on(double time, const std::vector<double>& parameters) override;
  const State<double>& state() const override { return state_; }
  double psi() const override { return span_of(psi_.get())[0]; }
  void interpolate(double time, State<double>* state, double* psi) override;
  void interpolate_rates(double time, State<double>* rates) override;
  Equations<double>& equations() override { return equations_.equations(); }
  Assembly& assembly() override { return assembly_; }
  void watch_singularities(bool watch) override { watch_singularities_ = watch; }
  const Statistics& statistics() const override { return statistics_; }
  Warnings warnings() const override;

  /// (q, v, s, z)_rho of tuned parameter k at the end of the last step.
  void sensitivity(int k, State<double>* direction) const {
    equations_.unpack(state_.t, y_rho_->span(k), y_dot_rho_->span(k), direction);
  }
  /// (q, v, s)_rho of all tuned parameters at `time` [s] within the last step, by the dense output;
  /// z is meaningless.
  void interpolate_sensitivities(double time, std::vector<State<double>>* directions);
  /// Derivative of psi() by tuned parameter k.
  double psi_sensitivity(int k) const { return psi_rho_->span(k)[0]; }
  /// Largest entry of |Phi(q)| at the end of a step since start().
  double largest_drift() const { return largest_drift_; }

 private:
  Status take_step(double limit);
  Status assemble(const std::vector<double>& parameters);
  void start_sensitivities(const std::vector<double>& parameters);
  void restart_solver();
  Status project();
  Status jump();
  template <class Change>
  Status begin_anew(const Change& change);
  void warn_of_restart();
  bool with_sensitivities() const { return carried_ && carried_->count() > 0; }
  void take_over(double time);
  Status check_run();
  void count_steps();

  const CompiledSystem& system_;
  const SolverOptions& options_;
  const double restart_drift_;
  const BreakTimes breaks_;
  ControlClock clock_;
  Assembly assembly_;
  MotionWatch watch_;
  RunWatch run_watch_;
  SingularityWatch singularity_;
  ContextHandle context_;
  IdasNewton newton_;
  IdasEquations equations_;
  Projection projection_;
  Continuation continuation_;
  VectorHandle y_, y_dot_, dense_, dense_dot_, psi_;
  std::unique_ptr<VectorArray> y_rho_, y_dot_rho_, psi_rho_, dense_rho_;
  IdaHandle ida_;
  IdasSensitivities* carried_ = nullptr;
  State<double> initial_, state_, before_jump_;
  std::vector<State<double>> directions_;
  std::vector<double> scales_;
  VectorX<double> drift_, drift_rate_, position_correction_, velocity_correction_;
  double work_ = 0.0;  ///< work of all forces but gravity so far [J]
  double largest_drift_ = 0.0, drift_size_ = 0.0;
  Statistics before_restart_;
  bool watch_singularities_ = false;
  bool has_stepped_ = false;  ///< since the last start() or go_on()
  RestartPace pace_;
  RepeatableStart repeatable_start_;
  Warnings restart_warnings_;
  std::string message_;
  Statistics statistics_;
};

}  // namespace codesign
