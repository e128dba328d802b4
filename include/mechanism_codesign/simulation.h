// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_SIMULATION_H_
#define MECHANISM_CODESIGN_SIMULATION_H_

#include <atomic>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "mechanism_codesign/frame.h"
#include "mechanism_codesign/problem.h"
#include "mechanism_codesign/statistics.h"
#include "mechanism_codesign/status.h"
#include "mechanism_codesign/warning.h"

namespace codesign {

struct SignalDescription;

/// One design of one mechanism, stepped forward in time. Not thread-safe; several may share one CompiledSystem.
class Simulation {
 public:
  /// @param parameters all named parameters, in the order of Problem::all_parameters().
  /// @param signals extra signals to sample into Frame::signals, as a study spells them: "crank_joint/velocity".
  /// @throws InputError for a signal that does not exist.
  Simulation(const Problem& problem, const std::vector<double>& parameters, const std::vector<std::string>& signals = {});
  /// The same with a compiled system and signals that are parsed already.
  Simulation(std::shared_ptr<const CompiledSystem> system, const std::vector<double>& parameters,
             const std::vector<SignalDescription>& signals);
  Simulation(std::shared_ptr<const CompiledSystem> system, const std::vector<double>& parameters);
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

#endif  // MECHANISM_CODESIGN_SIMULATION_H_
