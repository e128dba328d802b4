// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <atomic>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "description/motion_study.h"
#include "description/signal.h"
#include "jobs/json.h"
#include "mechanism_codesign/frame.h"
#include "mechanism_codesign/simulation.h"
#include "mechanism_codesign/status.h"
#include "problem/load_problem.h"

namespace codesign {

/// A limit of the URDF that a joint exceeds during a run.
struct LimitCrossing {
  std::string joint;
  std::string limit;  ///< lower, upper, velocity or effort
  /// the limit in the file; velocity and effort: a magnitude [rad or m, rad/s or m/s, N m or N]
  double bound = 0.0;
  double worst = 0.0;  ///< the value farthest beyond the limit
  double time = 0.0;   ///< time of the first sample, or step of a stop, beyond the limit [s]
};

/// Finds joints that exceed their `<limit>` during a run: velocities always, efforts unless the
/// study enforces them, and positions. A limit counts as exceeded if the excess is more than
/// absolute_tolerance + relative_tolerance * |bound| of the solver; that of a stop which the study
/// enforces if it gives way by more than 2 % of its range.
class LimitWatch {
 public:
  /// @param parameters all named parameters. @param names of the frames to observe. @param enforced
  /// the limits that the frames keep in any case.
  LimitWatch(const Problem& problem, const std::vector<double>& parameters, const FrameNames& names,
             const LimitOptions& enforced);
  LimitWatch(const Problem& problem, const std::vector<double>& parameters,
             const FrameNames& names);

  void observe(const Frame& frame);
  /// Adds what happened between the frames. @param stops Simulation::stops() of the run.
  void observe(const std::vector<StopExcess>& stops);
  const std::vector<LimitCrossing>& crossings() const { return crossings_; }

 private:
  struct Watched {
    std::size_t sample = 0;  ///< index into Frame::joints
    std::string joint, limit;
    double bound = 0.0;
    double margin = 0.0;  ///< beyond the bound
    int crossing = -1;    ///< index into crossings_ once the limit was exceeded
  };
  void note(Watched* watched, double value, bool beyond, double time);

  std::vector<Watched> watched_;
  std::vector<LimitCrossing> crossings_;
};

/// Finds joints that move in a run, but never as fast as the transition velocity of their gear, or
/// of friction that is given in N m or N.
class TransitionWatch {
 public:
  /// @param problem must outlive this. @param parameters all named parameters. @param names of the
  /// frames to observe.
  TransitionWatch(const Problem& problem, const std::vector<double>& parameters,
                  const FrameNames& names);

  void observe(const Frame& frame);
  /// A warning `transition_beyond_motion` for each such joint.
  Warnings warnings() const;

 private:
  struct Watched {
    std::size_t sample = 0;  ///< index into Frame::joints
    const FrictionDescription* friction = nullptr;
    std::string element;
    double transition = 0.0, fastest = 0.0;  ///< [rad/s or m/s]
  };
  std::vector<Watched> watched_;
};

/// The sentence that `codesign simulate` and `check` print for a crossing.
std::string describe(const LimitCrossing& crossing);

/// The outcome of a run: status, statistics, exceeded limits and warnings.
struct RunSummary {
  Status status;
  Statistics statistics;
  std::vector<MethodChange> methods;     ///< Simulation::methods()
  std::vector<LimitCrossing> crossings;  ///< found at the sampled instants
  Events events;                         ///< Simulation::events()
  Warnings warnings;                     ///< Simulation::warnings()
  double end = 0.0;                      ///< of the run [s]
  /// Processor time of the samples and of `sink` [s], which `statistics` do not count.
  double sample_seconds = 0.0;
  /// The study's objective; empty if the study has none or a peak, or if the run stops before its
  /// end.
  std::optional<double> objective;
};

/// Receives the row `time, signal, ...` of each instant.
using RowSink = std::function<void(const std::vector<double>&)>;

/// Runs a study at `parameters` and calls `sink` with the values of `signals` at `samples` equally
/// spaced instants from 0 to its duration.
/// @param parameters all named parameters. @param cancel once set, the run ends soon with
/// kCancelled; nullptr: no cancellation.
RunSummary record_run(const Problem& problem, const std::vector<double>& parameters,
                      const std::vector<SignalDescription>& signals, int samples,
                      const RowSink& sink, const std::atomic<bool>* cancel = nullptr);

/// The columns of the rows: `time`, then the signals as the user wrote them.
std::vector<std::string> column_names(const std::vector<SignalDescription>& signals);

/// The record of a run of one design: a table for people and plotting, and a summary for the
/// report.
struct DesignRecord {
  Status status;
  std::string csv;  ///< `time` and shown_signals(), at 501 equally spaced instants
  /// `signals` (name, unit, smallest, largest, their times, limits), `energy` and `friction_energy`
  /// [J], `limits_exceeded`, `poses`.
  Json summary;
};

/// Runs the nominal study at `parameters`. Peaks are taken over 1001 samples; energies are
/// integrals of powers over these samples by Simpson's rule, negative if energy leaves the
/// mechanism.
/// @param parameters all named parameters. @param cancel once set, the run ends soon with
/// kCancelled; nullptr: no cancellation.
DesignRecord record_design(const Problem& problem, const std::vector<double>& parameters,
                           const std::atomic<bool>* cancel = nullptr);

}  // namespace codesign
