// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <atomic>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "identification/identify.h"
#include "identification/regressor.h"
#include "jobs/files.h"
#include "jobs/json.h"
#include "mechanism_codesign/optimization.h"
#include "optimization/tradeoff.h"
#include "problem/load_problem.h"

namespace codesign::python {

/// Called with each trial point, and about once a second with the progress of a stage: the line
/// that the command line prints, and the numbers in it. False ends the job.
using Tell = std::function<bool(const std::string& line, const Json& fields)>;

/// A finished optimization.
struct Optimized {
  Problem problem;
  OptimizationResult result;
  std::string json;  ///< the text of result.json
  std::vector<Trial> trials;
};

/// `codesign optimize`. @param tell may be empty. @throws InputError as the command line
Optimized optimize(const Problem& problem, const Tell& tell, const std::atomic<bool>* cancel);

/// Writes what `codesign optimize --output` leaves, but its journal, into a folder that is made if
/// it is not there. @throws InputError if a file would replace one from which the problem was read
std::vector<Failure> write_folder(const Optimized& optimized, const std::string& folder,
                                  const std::atomic<bool>* cancel);

/// A finished trade-off.
struct Traded {
  Problem problem;
  TradeoffResult result;
  std::string json;  ///< the text of `codesign tradeoff --json`
};

/// `codesign tradeoff`. @param points 0: the default. @throws InputError as the command line
Traded tradeoff(const Problem& problem, int points, const Tell& tell,
                const std::atomic<bool>* cancel);

/// A recording as a program has it.
struct RecordedArrays {
  std::string element;  ///< for messages: `recordings[0]`
  std::vector<double> times;
  std::vector<JointSamples> joints;
  std::vector<SignalSamples> signals;
  ParameterSettings settings;    ///< values of parameters in this recording
  std::vector<SpeedMask> masks;  ///< with a joint, or of all joints
  RestRule rest = RestRule::kLeaveOut;
  std::vector<StartPosition> starts;  ///< known ones
};

/// The recordings of an identification, in place of those that a study names.
struct RecordingArrays {
  std::vector<RecordedArrays> data, holdout;
};

/// A finished identification.
struct Identified {
  Problem problem;
  IdentificationResult result;
  std::string json;  ///< the text of identification.json
};

/// `codesign identify`. @param is_fitted false: `--evaluate`. @param arrays in place of the
/// recordings that the study names; the study may then be without `identify:`. @throws InputError
/// as the command line
Identified identify(const Problem& problem, const std::optional<RecordingArrays>& arrays,
                    bool is_fitted, const Tell& tell, const std::atomic<bool>* cancel);

/// find_regressor() of recordings. @param design values of all named parameters. @throws InputError
/// as identify()
Regressor regressor(const Problem& problem, const RecordingArrays& arrays,
                    const std::vector<double>& design, const std::atomic<bool>* cancel);

/// Writes the text files that `codesign identify --output` leaves. @throws as above
std::vector<Failure> write_folder(const Identified& identified, const std::string& folder);

}  // namespace codesign::python
