// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <atomic>
#include <stdexcept>
#include <string>
#include <vector>

#include "problem/load_problem.h"

namespace codesign {

/// The design in a result.json, best.json or identification.json: every entry of its `parameters`,
/// to the last bit.
/// @throws InputError naming file and line if it is not JSON, has a number beyond the range of
/// double, or no object `parameters` of numbers.
ParameterSettings read_result(const SourceText& json);
/// The same, with the name of the file.
inline SavedDesign read_design(const SourceText& json) { return {json.name, read_result(json)}; }

/// What became of a request to give a robot the values of a result; doc/ros_api.md, Apply.
struct ApplyRecord {
  struct Change {
    std::string server, name;
    double before, after, now;
  };
  bool success;
  std::string code, message;
  std::vector<Change> changes;
  double rollback_seconds;
};

/// The output of the node apply with --json.
std::string apply_text(const ApplyRecord& record);

/// The values of a result are not the values that an optimization has simulated.
class NeverSimulated : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// A finished optimization whose files agree with each other and with a simulation.
struct FinishedJob {
  std::string folder;
  Problem problem;  ///< loaded from tuned.urdf and job_study.yaml, at the design of result.json
  /// all named parameters of that design, in the order of Problem::all_parameters()
  std::vector<double> parameters;
  std::vector<std::string> tuned;  ///< names of the parameters that the job has tuned
  double objective = 0.0;          ///< from result.json
};

/// The folder of a job: `path` without a final `.bag`.
std::string folder_of_job(const std::string& path);

/// Opens the folder of a finished optimization and proves that its design was simulated:
/// - result.json has no error, and the folder is complete;
/// - the design is a trial point of convergence.csv, its other parameters have the values of
///   initial.json, and tuned.urdf has the same values, each to the last bit; gains.yaml, if there
///   is one, has the gains of this design;
/// - the objective, computed once more, equals the objective in result.json, within 1e-6 of itself
///   plus 1e-9 of the initial objective.
/// @param path of the folder or of the bag beside it. @param loader as in load_problem(). @param
/// cancel ends the simulation early.
/// @throws InputError for files that are missing or cannot be read, and for parameters outside
/// their bounds; NeverSimulated, naming file, parameter and both values, for a job that did not
/// finish and for values that were changed after it.
FinishedJob read_finished_job(const std::string& path, const TrajectoryLoader& loader = {},
                              const std::atomic<bool>* cancel = nullptr);

}  // namespace codesign
