// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mechanism_codesign/Commands.h>

#include <optional>
#include <vector>

#include "integration/interactive_simulation.h"
#include "ros/command_reading.h"
#include "ros/run_clock.h"

namespace codesign {

/// Applies commands to a run, and ends efforts that are not renewed.
class CommandedRun {
 public:
  /// @param run must outlive this. @param timeout [s] of the run after which efforts are zero; 0: never
  CommandedRun(InteractiveSimulation* run, double timeout) : run_(run), timeout_(timeout) {}

  /// Drops all commands, for a new run.
  void clear();

  /// The outcome of the commands at an instant.
  struct Outcome {
    Status status;         ///< of InteractiveSimulation::apply()
    bool changed = false;  ///< whether the commands in effect have changed
  };
  /// Applies the last command of each joint and controller in `commands`. @param frame the last frame, sampled at the present instant.
  /// @param clock gives the time of a trajectory's stamp.
  Outcome apply(const std::vector<Command>& commands, const Frame& frame, const RunClock& clock);
  /// Whether a timeout has ended the efforts and no command has arrived since.
  bool is_timed_out() const { return timed_out_; }

  /// The commands in effect at `time` [s]; the stamp is for the caller to set.
  mechanism_codesign::Commands message(double time) const;

 private:
  void take(const EffortCommand& command, double time);
  void take(const SetpointCommand& command, double time);
  void take(const TrajectoryCommand& command, const Frame& frame, const RunClock& clock);
  void follow(const JointCourse& course, double begin, const Frame& frame);
  bool end_efforts(double time);

  InteractiveSimulation* run_;
  double timeout_;
  std::optional<double> last_effort_;  ///< time of the last effort command [s]
  bool timed_out_ = false;
};

}  // namespace codesign
