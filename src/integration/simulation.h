// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_INTEGRATION_SIMULATION_H_
#define MECHANISM_CODESIGN_INTEGRATION_SIMULATION_H_

#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "description/robot.h"
#include "description/study.h"
#include "mechanism_codesign/frame.h"
#include "mechanism_codesign/status.h"

namespace codesign {

class CompiledSystem;  // the immutable equations of motion, equations/system.h

/// What an integration cost.
struct Statistics {
  std::int64_t steps = 0, rejected_steps = 0;
  double cpu_seconds = 0.0;       ///< of the run
  double constraint_drift = 0.0;  ///< largest violation of Phi and of Phi_q v after a step, in the scale of the error test [-]
  double energy_error = 0.0;      ///< largest |E - E(0) - work done| over the run, relative to the largest energy that took part [-]
};

/// One design of one mechanism, stepped forward in time. Not thread-safe; several may share one CompiledSystem.
class Simulation {
 public:
  /// @param parameters all named parameters (Study::parameters order).
  /// @param signals extra signals to sample into Frame::signals. @throws InputError for one that does not exist.
  Simulation(std::shared_ptr<const CompiledSystem> system, const std::vector<double>& parameters,
             const std::vector<SignalDescription>& signals = {});
  ~Simulation();
  Simulation(Simulation&&) noexcept;
  Simulation& operator=(Simulation&&) noexcept;

  /// Assembles positions, velocities, accelerations and reactions at t = 0.
  Status start();

  /// Integrates until `time` lies inside the last step. May be called again and again, past Study::duration too.
  Status advance(double time);

  /// Samples everything at `time`, which must lie inside the last step taken (or be 0 after start()).
  void sample(double time, Frame* frame);

  /// From now on advance() ends with kCancelled soon after `cancel` is set, from any thread. Null: never.
  void obey(const std::atomic<bool>* cancel);

  const FrameNames& names() const;
  const Statistics& statistics() const;
  /// What became doubtful during the run: a singular position passed, a reaction that nothing determines.
  const Warnings& warnings() const;

 private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

/// Called for each sample; returning false cancels.
using FrameObserver = std::function<bool(const Frame&)>;

/// Runs a whole study at `parameters`, sampling at `count` equally spaced instants from 0 to its duration.
/// @param cancel if given and set, the run ends with kCancelled, between samples too.
/// @returns kNonFinite at the first sample that is not finite throughout, which the observer does not get to see.
Status simulate(Simulation* simulation, double duration, int count, const FrameObserver& observer,
                const std::atomic<bool>* cancel = nullptr);

}  // namespace codesign

#endif  // MECHANISM_CODESIGN_INTEGRATION_SIMULATION_H_
