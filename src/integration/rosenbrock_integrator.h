// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <vector>

#include "assembly/assembly.h"
#include "control/control_clock.h"
#include "integration/continuation.h"
#include "integration/expression_watch.h"
#include "integration/integrator.h"
#include "integration/method_choice.h"
#include "integration/mode_watch.h"
#include "integration/one_step.h"
#include "integration/run_ends.h"
#include "integration/run_watch.h"
#include "integration/singularity_watch.h"
#include "integration/stability_bound.h"
#include "integration/step_control.h"

namespace codesign {

/// Adaptive Rosenbrock-Wanner method, doc/theory.md (15)-(17), by the tableau that solver.method
/// selects. Once warm, steps do not allocate.
class RosenbrockIntegrator final : public Integrator {
 public:
  explicit RosenbrockIntegrator(const CompiledSystem& system);

  Status start(const std::vector<double>& parameters) override;
  Status advance(double limit) override { return advance(limit, {}); }
  Status go_on(double time, const std::vector<double>& parameters) override;
  const State<double>& state() const override { return step_.state(); }
  double psi() const override { return step_.psi(); }
  void interpolate(double time, State<double>* state, double* psi) override;
  void interpolate_rates(double time, State<double>* rates) override;
  Equations<double>& equations() override { return step_.equations(); }
  Assembly& assembly() override { return assembly_; }
  void watch_singularities(bool watch) override { watch_singularities_ = watch; }
  const Statistics& statistics() const override { return statistics_; }
  Warnings warnings() const override;

  /// Called for a step whose error is below 1, before OneStep::accept(); computes the
  /// tangent of its stages there. Returns a scaled error, and the step is rejected if that
  /// exceeds 1.
  using BeforeAccept = std::function<double(OneStep<double>*)>;

  Status advance(double limit, const BeforeAccept& before_accept);

  /// Carries the run over what happens at the end of the last step: the mode changes, theory (17d),
  /// and sampled controllers act, (51). advance() calls it by itself; a caller that needs
  /// mode_change(), jump_events() and before_jump() calls it before advance().
  Status jump();
  /// Whether the last jump() did anything.
  bool has_jumped() const { return has_jumped_; }
  /// The first change of the mode in the last jump(); its `guard` is -1 if a step did not end there
  /// because of a guard.
  const ModeChange& mode_change() const { return mode_change_; }
  /// The guard at whose zero the last step ended, before jump() carries the run over it; -1 if
  /// none.
  int guard() const { return mode_watch_.is_due() ? mode_watch_.guard() : -1; }
  /// The guard that has ended the run, -1 if none.
  int end_guard() const { return is_ended() ? mode_watch_.guard() : -1; }
  /// The rate of either along the motion before it [per s]; 0 if it is only touched.
  double guard_rate(const State<double>& at, const State<double>& rates) {
    return mode_watch_.end_rate(at, rates);
  }
  /// Looks at the guard that has ended the run: warns of `grazing_event` if it is hardly more than
  /// touched. @param rate of it. @returns kNonFiniteGradient if the end has no derivative.
  Status judge_end(double rate);
  ModeWatch& mode_watch() { return mode_watch_; }
  /// The mode that the equations hold now; empty without switches.
  const std::vector<bool>& mode() const { return mode_watch_.mode(); }
  bool ends_at_switch() const override { return mode_watch_.is_due(); }
  /// The events of the last jump(), none if there was nothing to do, and the state before them.
  const std::vector<ControlEvent>& jump_events() const { return jump_events_; }
  const State<double>& before_jump() const { return before_jump_; }

  const OneStep<double>& step() const { return step_; }
  OneStep<double>& step() { return step_; }
  const State<double>& initial_state() const { return initial_; }

 private:
  Status begin(const std::vector<double>& parameters);
  /// Changes the mode if that is due. @param change what happened.
  Status change_mode(ModeChange* change);
  /// Ends the run if its condition holds behind a change of the mode.
  /// @returns kInvalidDesign at the start.
  Status look_for_end(const State<double>& behind);
  /// The events of sampled controllers.
  Status sample();
  /// The scaled error of the motion and of the objective in the last attempt.
  double own_error() const;
  /// Of an attempt that passes the error test of the motion: cuts it where the mode changes, and
  /// returns the scaled error of what else takes part.
  double further_error(const BeforeAccept& before_accept);
  double first_step() const;
  struct NextStep {
    double h, end;               ///< size, and where steps end at the latest [s]
    bool is_last;                ///< whether it reaches `end`
    bool ends_at_break = false;  ///< a rounding before a break time
  };
  NextStep next_step(double t, double limit, double smallest) const;
  /// Takes another method for the next step if the last one suggests that.
  void choose_method();
  /// Whether stability allows the last attempt, of size h [s]; else shortens the next one.
  bool is_stable(double h);
  /// Moves the end of the last step to a break time.
  void cross_break(double t);
  /// Counts and checks a step that was accepted.
  Status look();

  const CompiledSystem& system_;
  const SolverOptions& options_;
  const BreakTimes breaks_;
  ControlClock clock_;
  std::vector<ControlEvent> jump_events_;
  State<double> before_jump_, behind_jump_;
  VectorX<double> residual_before_, residual_behind_;
  OneStep<double> step_;
  Assembly assembly_;
  State<double> initial_;
  StepController controller_;
  MethodChoice choice_;
  StabilityBound stability_;
  bool chooses_ = false;  ///< whether a step was accepted since the method was chosen
  MotionWatch watch_;
  RunWatch run_watch_;
  StepWork work_;
  SingularityWatch singularity_;
  ModeWatch mode_watch_;
  ExpressionWatch expression_watch_;
  ModeChange mode_change_, second_change_;
  bool has_jumped_ = false;
  Continuation continuation_;
  bool watch_singularities_ = false;
  RepeatableStart repeatable_start_;
  double proposal_ = 0.0;
  Statistics statistics_;
};

}  // namespace codesign
