// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <atomic>
#include <memory>
#include <vector>

#include "equations/compiled_system.h"
#include "integration/event_log.h"
#include "mechanism_codesign/simulation.h"
#include "mechanism_codesign/status.h"
#include "text/cancel.h"

namespace codesign {

class Assembly;
template <class T>
class Equations;

/// Integrates one design of a mechanism step by step. start() may be called again for another
/// design and reuses the memory. Not thread-safe.
class Integrator {
 public:
  virtual ~Integrator() = default;

  /// Assembles the initial state of a design at t = 0. @param parameters all named parameters
  /// (Study::parameters order).
  /// @returns the status of assemble_start().
  virtual Status start(const std::vector<double>& parameters) = 0;
  /// Takes one accepted step that ends at `limit` [s] or before. Rejected attempts are repeated
  /// with smaller steps.
  virtual Status advance(double limit) = 0;

  /// Goes on from `time` [s] within the last step, where inputs have jumped (LiveFunction) or the
  /// design changes, doc/theory.md (55): the part of the step after that instant is discarded, and
  /// psi() is the integral up to it. Without sensitivities.
  /// @param parameters all named parameters after that instant. @returns ok, or a failure of
  /// Continuation::cross(), after which the run is unchanged.
  virtual Status go_on(double time, const std::vector<double>& parameters) = 0;

  /// The state at the end of the last step; after start(), the initial state.
  virtual const State<double>& state() const = 0;
  /// Integral of the objective's integrand g from 0 to state().t, doc/theory.md (21).
  virtual double psi() const = 0;
  /// The objective so far, with its terminal terms only if they are given; zero where the error of
  /// the steps has made a sum of losses negative, doc/theory.md (21).
  /// @param integral psi() or a value of it by interpolate().
  double of_losses(double integral, double terminal = 0.0);
  /// Dense output at `time` [s] within the last step: state and psi. Accelerations and multipliers
  /// in `state->z` are of lower accuracy.
  virtual void interpolate(double time, State<double>* state, double* psi) = 0;

  /// The time derivative of the dense output: the parts q, v and s of `rates` [per s].
  virtual void interpolate_rates(double time, State<double>* rates) = 0;

  /// Where a run of this design ends at the latest [s], doc/theory.md (21g); after start().
  double end() const { return end_; }
  /// Whether the last step ends where the run does. Commanded runs go on beyond end().
  bool has_ended() const { return is_ended_ || state().t >= end_; }
  /// Whether the condition of Study::until has ended the run; it cannot go on.
  bool is_ended() const { return is_ended_; }

  virtual Equations<double>& equations() = 0;
  virtual Assembly& assembly() = 0;
  /// Whether formulas may switch at the end of the last step, so that accelerations, multipliers
  /// and what depends on them may jump there: the next step begins with other ones.
  virtual bool ends_at_switch() const { return false; }
  /// Whether runs look for singular positions that they pass, doc/theory.md (17b), to report in
  /// warnings(); from the next start() on.
  virtual void watch_singularities(bool watch) = 0;
  virtual const Statistics& statistics() const = 0;
  /// As Simulation::methods().
  const std::vector<MethodChange>& methods() const { return methods_; }
  /// The events of the run since start(); none by `idas` and in postures.
  const EventLog& events() const { return log_; }
  /// Warnings about the run since start().
  virtual Warnings warnings() const = 0;

  /// Once `cancel` is set (by any thread), start() and advance() end soon with kCancelled, even
  /// while a step is being retried. nullptr: no cancellation.
  void obey(const std::atomic<bool>* cancel);

 protected:
  bool cancelled() const { return is_set(cancel_); }
  /// kInvalidDesign for a duration that no run can have.
  static Status check_end(const MotionStudy& study, const std::vector<double>& parameters);
  /// Sets end(). @returns check_end().
  Status begin_run(const MotionStudy& study, const std::vector<double>& parameters);
  /// The same while a run goes on with other parameters. @param between whether it goes on from
  /// before the end of the last step, so that the end found there counts no more.
  void go_on_run(const MotionStudy& study, const std::vector<double>& parameters, bool between);
  void end_run() { is_ended_ = true; }
  /// `until_not_reached`, where a run has gone on to its duration.
  Warnings end_warnings(const MotionStudy& study) const;
  void begin_methods(const char* method) { methods_.assign(1, {0.0, method}); }
  void change_method(double time, const char* method) { methods_.push_back({time, method}); }

  EventLog log_;  ///< of the run

 private:
  std::vector<MethodChange> methods_;
  double end_ = 0.0;
  bool is_ended_ = false;
  const std::atomic<bool>* cancel_ = nullptr;
};

/// The integrator of the study, or the sequence of its postures. @param system must outlive it.
std::unique_ptr<Integrator> make_integrator(const CompiledSystem& system);

/// Checks that the design in `equations` is possible: kInvalidDesign with the first impossible
/// constant, or ok.
Status check_design(const CompiledSystem& system, const Equations<double>& equations);

/// Sets the design in `equations` and solves for a consistent initial state at t = 0.
/// @returns kInvalidDesign for constants that no mechanism can have (such as a negative mass), else
/// the status of Assembly::solve().
Status assemble_start(const CompiledSystem& system, const std::vector<double>& parameters,
                      Assembly* assembly, Equations<double>* equations, State<double>* initial);

/// Starts the runs of an integrator, each with the pivots that are chosen at the study's own start.
/// The last bits of a run then depend on its design alone, and pivots need not be chosen for each
/// run. See doc/decisions/0049-journal.md.
class RepeatableStart {
 public:
  /// Before the first run, unless it is the study's own, the study's own start is begun and
  /// its pivots are kept.
  /// @param parameters of this run. @param begin (parameters) -> Status: assembles the start, which
  /// factors the matrices.
  /// @param keep_pivots () -> keeps their present pivots, SparseLu::keep_pivots().
  /// @returns the status of begin(parameters).
  template <class Begin, class Keep>
  Status start(const CompiledSystem& system, const std::vector<double>& parameters,
               const Begin& begin, const Keep& keep_pivots) {
    const bool is_first = !has_begun_, is_own = is_first && parameters == system.parameters();
    has_begun_ = true;
    if (is_first && !is_own && begin(system.parameters()).ok()) keep_pivots();
    Status status = begin(parameters);
    if (is_own && status.ok()) keep_pivots();
    return status;
  }

 private:
  bool has_begun_ = false;  ///< whether the study's own start was begun
};

}  // namespace codesign
