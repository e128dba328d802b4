// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "mechanism_codesign/frame.h"
#include "mechanism_codesign/simulation.h"
#include "mechanism_codesign/status.h"
#include "problem/load_problem.h"

namespace codesign {

/// Longest run in ROS time [s], whose seconds have 32 bits.
inline constexpr double kLongestRun = 2e9;

/// Advances a run from time `from` to `to` [s] and calls `stop()` sixteen times on the way, since
/// this may take long. The division does not change the steps of the integrator. @returns
/// kCancelled if `stop()` was true, else the status of the run.
template <class Stop>
Status advance(Simulation* simulation, double from, double to, Stop&& stop) {
  constexpr int kSlices = 16;
  Status status;
  for (int k = 1; k <= kSlices && status.ok(); ++k) {
    const double time = k == kSlices ? to : from + (to - from) * k / kSlices;
    if (stop()) return {StatusCode::kCancelled, time, "cancelled"};
    status = simulation->advance(time);
  }
  return status;
}

/// An event of a run, and the link at which it is shown.
struct RunEvent {
  Event event;
  /// index in FrameNames::links: the link, or the child of the joint, on which the element acts;
  /// the root if there is none
  std::size_t link = 0;
};

/// A run of a study at one design, sampled at a fixed rate.
struct RecordedRun {
  FrameNames names;
  std::vector<Frame> frames;
  Status status;  ///< if not ok, the frames end where the run failed or was stopped
  std::vector<std::size_t> link_parents{};  ///< as link_parents() finds them
  std::vector<RunEvent> events{};           ///< the events of Simulation::events()
};

/// Checks that the runs of a job (nominal and worst scenario of both designs) fit into memory (256
/// MB) and into the range of ROS time.
/// @param rate samples per second.
/// @param element where the rate was given. @throws InputError for a duration or a rate that is too
/// large.
void check_recording(const Problem& problem, double rate, const std::string& element);

/// Runs a study at `parameters`, all named ones, and samples it at equally spaced instants from 0
/// to its duration.
/// @param system of the run, such as the system of a scenario. @param rate samples per second,
/// accepted by check_recording(). @param stop if given, called repeatedly; true ends the run with
/// kCancelled.
RecordedRun record_run(const std::shared_ptr<const CompiledSystem>& system,
                       const std::vector<double>& parameters, double rate,
                       const std::function<bool()>& stop = {});

}  // namespace codesign
