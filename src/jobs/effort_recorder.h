// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <atomic>
#include <string>
#include <utility>
#include <vector>

#include "description/signal.h"
#include "jobs/json.h"
#include "jobs/run_recorder.h"
#include "mechanism_codesign/status.h"
#include "mechanism_codesign/warning.h"
#include "problem/load_problem.h"

namespace codesign {

/// The value of largest magnitude, with its sign, and where it occurs: the time [s], or the
/// posture.
struct Extreme {
  double value = 0.0;
  std::vector<double> at;
};

/// What one drive needs over all rows.
struct DriveNeeds {
  std::string joint;
  /// Along a motion `effort` [N m or N], `velocity` and `power` [W]; in postures `effort` (at rest
  /// without friction), `holding` and `breakaway`, PostureEffort.
  std::vector<std::pair<std::string, Extreme>> extremes;
  /// Along a motion `rms_effort`, and `work` [J] by the trapezoidal rule.
  std::vector<std::pair<std::string, double>> totals;
};

/// The outcome of a table of efforts.
struct EffortSummary {
  Status status;
  std::size_t rows = 0, unreachable = 0;  ///< rows in all; postures that the loops do not allow
  std::vector<DriveNeeds> drives;
  std::vector<LimitCrossing> crossings;  ///< along a motion
  Warnings warnings;                     ///< `singular_posture`
};

/// The columns of record_efforts(): along a motion `time` and of each given joint position,
/// velocity, acceleration and effort; in the postures of `efforts.grid` the positions of its
/// joints, and of each of them `effort`, `breakaway_down`, `breakaway_up` and `holding`. Then
/// `signals`.
std::vector<std::string> effort_columns(const Problem& problem,
                                        const std::vector<SignalDescription>& signals);

/// The efforts that the motion of a study needs, at `samples` equally spaced instants from 0 to its
/// duration, or in the postures of its grid; doc/theory.md (28), (65). A row whose posture the
/// loops do not allow has NaN in place of efforts.
/// @param parameters all named parameters. @param signals further columns; there are no
/// controllers.
/// @param cancel once set, ends soon with kCancelled; nullptr: never.
/// @throws InputError if the study gives no motion, or one that does not determine the mechanism's.
EffortSummary record_efforts(const Problem& problem, const std::vector<double>& parameters,
                             const std::vector<SignalDescription>& signals, int samples,
                             const RowSink& sink, const std::atomic<bool>* cancel = nullptr);

/// By joint: each extreme as `{value, at}`, and the totals.
Json to_json(const std::vector<DriveNeeds>& drives);

}  // namespace codesign
