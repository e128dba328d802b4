// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <atomic>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "mechanism_codesign/event.h"
#include "mechanism_codesign/frame.h"
#include "mechanism_codesign/problem.h"
#include "mechanism_codesign/statistics.h"
#include "mechanism_codesign/status.h"
#include "mechanism_codesign/warning.h"

namespace codesign {

/// From when on a run's steps were taken by another method.
struct MethodChange {
  double time = 0.0;        ///< [s]
  const char* method = "";  ///< as in `solver.method`, or "idas"
};

/// A stop that the study enforces and that gave way by more than 2 % of its range.
struct StopExcess {
  std::string joint;
  bool is_upper = false;
  double bound = 0.0;  ///< of the model [rad or m]
  double worst = 0.0;  ///< the position farthest beyond it, at the end of a step [rad or m]
  double time = 0.0;   ///< from when on [s]
};

/// A run of one design, integrated step by step: start(), then advance() and sample() as often as
/// needed. Not thread-safe; any number of simulations may share one Problem, each in its own
/// thread.
class Simulation {
 public:
  /// @param parameters values of all named parameters, in the order of Problem::all_parameters().
  /// @param signals signals to sample into Frame::signals, spelled as in a study:
  /// "crank_joint/velocity".
  /// @throws InputError for a signal that does not exist or cannot be read.
  Simulation(const Problem& problem, const std::vector<double>& parameters,
             const std::vector<std::string>& signals = {});
  ~Simulation();
  Simulation(Simulation&&) noexcept;
  Simulation& operator=(Simulation&&) noexcept;

  /// Assembles positions, velocities, accelerations and reactions at t = 0, theory (19); the status
  /// says whether and why this failed. Call start() before the functions below; a second call
  /// starts the run again.
  Status start();

  /// Integrates until `time` [s] lies within the last step; returns at once if it does already.
  /// `time` may exceed the study's duration. After a status that is not ok the run cannot be
  /// continued.
  Status advance(double time);

  /// As advance(), but the last step ends at `time`.
  Status advance_to(double time);

  /// Goes on from `time` [s], which must lie within the last step (or be 0 after start()), with
  /// other parameter values. Positions and velocities stay; if dimensions change, the independent
  /// coordinates stay and the loops are closed from there. Accelerations and reactions follow the
  /// new values, and the energy balance begins again. The part of the last step after `time` is
  /// discarded.
  /// @param parameters values of all named parameters. @returns kInvalidDesign, kAssemblyFailed or
  /// another status if the mechanism cannot have these values at `time`; the run then continues
  /// with the previous values.
  Status go_on(double time, const std::vector<double>& parameters);

  /// Fills `frame` with everything at `time` [s], which must lie within the last step (or be 0
  /// after start()), by the dense output of the step.
  void sample(double time, Frame* frame);

  /// The study's objective at the end of the last step, in the units of its terms: the integral and
  /// the terminal terms there, without peaks, doc/theory.md (21). It is that of the study if the
  /// last step ends at the study's duration.
  double objective();
  /// The end of the last step [s].
  double time() const;
  /// Where a run with these parameters ends [s], after start(): its duration, or with `until` the
  /// longest one.
  double end() const;
  /// Whether the study's condition `until` has ended the run, at time(), which may lie behind the
  /// instant of the last advance(): it advances no more, and later instants are sampled as its end.
  bool has_ended() const;
  /// Whether the study has such a condition; whether the end of runs depends on their parameters.
  bool may_end() const;
  bool has_moving_end() const;

  /// Makes start() and advance() end with kCancelled soon after `cancel` is set, from any thread;
  /// null makes them ignore it. The flag must outlive the simulation or the next call of obey().
  void obey(const std::atomic<bool>* cancel);

  /// The names of the entries of every frame.
  const FrameNames& names() const;
  /// Cost and accuracy of the run so far.
  const Statistics& statistics() const;
  /// The methods of the run so far: that of the first step, then each change of `method: auto`.
  const std::vector<MethodChange>& methods() const;
  /// The events of the run so far, and their number, which costs nothing. The integrator `idas` and
  /// postures have none.
  Events events() const;
  std::int64_t event_count() const;
  /// The stops of the run so far that gave way, in the order of their times.
  const std::vector<StopExcess>& stops() const;
  /// Warnings of the run so far, such as `constraint_drift`, `energy_error` and `singular_start`;
  /// doc/warnings.md lists the codes.
  const Warnings& warnings() const;

 private:
  friend struct SimulationMaker;
  class Implementation;
  explicit Simulation(std::unique_ptr<Implementation> implementation);

  std::unique_ptr<Implementation> implementation_;
};

/// Called for each sample of a run; returning false ends the run with kCancelled.
using FrameObserver = std::function<bool(const Frame&)>;

/// Runs a simulation from t = 0 to `duration` [s], or to its own end if that is earlier, and hands
/// `count` samples at equal distances, both ends included, to the observer. A study with `until` is
/// run twice: first to its end.
/// @param cancel the run ends with kCancelled soon after this is set, from any thread; null: never.
/// @returns kNonFinite at the first sample with a number that is not finite; that sample is not
/// handed to the observer.
Status simulate(Simulation* simulation, double duration, int count, const FrameObserver& observer,
                const std::atomic<bool>* cancel = nullptr);

}  // namespace codesign
