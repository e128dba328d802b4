// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "description/motion_study.h"
#include "description/signal.h"
#include "jobs/json.h"
#include "mechanism_codesign/optimization.h"
#include "problem/load_problem.h"

namespace codesign {

/// A signal in the result files: the text of its axis, and its limits in the URDF.
struct ShownSignal {
  SignalDescription signal;
  std::string unit;  ///< SI; empty: none
  /// limits of the URDF at one design, whether the study enforces them or not
  std::optional<double> lower, upper;
};

/// The signals of initial.csv and tuned.csv: default_signals(), then the efforts that controllers
/// apply, their errors, the powers of friction by joint, the powers of the whole mechanism, and all
/// other signals that the study reads, each once. @param parameters all named parameters.
std::vector<ShownSignal> shown_signals(const Problem& problem,
                                       const std::vector<double>& parameters);

/// The unit of a signal, by its first term.
std::string unit_of(const SignalDescription& signal, const RobotDescription& robot,
                    const std::vector<ControllerDescription>& controllers);

/// Adds the list `signals`: of each signal with a constraint or a peak its bounds, its range before
/// and after, in which run and sample, and the violation. Nothing without one.
void add_watched(const OptimizationResult& result, Json* object);

}  // namespace codesign
