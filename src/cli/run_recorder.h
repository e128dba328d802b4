// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_CLI_RUN_RECORDER_H_
#define MECHANISM_CODESIGN_CLI_RUN_RECORDER_H_

#include <atomic>
#include <functional>
#include <string>
#include <vector>

#include "cli/limit_watch.h"
#include "mechanism_codesign/simulation.h"
#include "problem/load_problem.h"

namespace codesign::cli {

/// How a run ended and what it cost.
struct RunSummary {
  Status status;
  Statistics statistics;
  std::vector<LimitCrossing> crossings;  ///< seen at the sampled instants
  Warnings warnings;                     ///< Simulation::warnings()
};

/// Called with `time, signal, ...` at each instant.
using RowSink = std::function<void(const std::vector<double>&)>;

/// Runs a study at `parameters` and hands on its signals at `samples` equally spaced instants.
/// @param cancel if given and set, the run ends with kCancelled.
RunSummary record_run(const Problem& problem, const std::vector<double>& parameters, const std::vector<SignalDescription>& signals,
                      int samples, const RowSink& sink, const std::atomic<bool>* cancel = nullptr);

/// `time`, then the signals as written.
std::vector<std::string> column_names(const std::vector<SignalDescription>& signals);

}  // namespace codesign::cli

#endif  // MECHANISM_CODESIGN_CLI_RUN_RECORDER_H_
