// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mechanism_codesign/EvaluateRequest.h>
#include <mechanism_codesign/IdentifyGoal.h>
#include <mechanism_codesign/OptimizeGoal.h>

#include <Eigen/Core>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "jobs/files.h"
#include "problem/load_problem.h"

namespace codesign {

/// Refuses lists with more entries than the problem has parameters, and names of more than 1000
/// letters, before the lists are copied or searched. @throws InputError naming the field of the
/// request.
/// @param values_field the name of the field that holds `values`, for the message.
void check_size(const Problem& problem, const std::vector<std::string>& names,
                const std::vector<double>& values, const std::string& values_field);

/// The problem and the optimizer options of one optimization job.
struct OptimizationRequest {
  Problem problem;
  OptimizerOptions options;
};

/// Applies a goal to the loaded problem: sets the parameters to tune, their start values and the
/// optimizer options as far as the goal gives them; the rest is as in the study.
/// @throws InputError naming the field of the request, or if the study has no objective.
OptimizationRequest apply_request(const Problem& problem,
                                  const mechanism_codesign::OptimizeGoal& request);

/// Applies a goal of `identify` to the loaded problem: the parameters to fit, their start values
/// and the limits of the fit.
/// @throws InputError naming the field of the request, or if the study has no recordings.
Problem apply_request(const Problem& problem, const mechanism_codesign::IdentifyGoal& request);

/// The tuned parameters rho (order of Study::tuned) of a request for an evaluation: the values of
/// the request, and start values for the parameters that it does not name.
/// @throws InputError naming the field of the request, or if the study has no objective.
Eigen::VectorXd design_of(const Problem& problem,
                          const mechanism_codesign::EvaluateRequest& request);

/// Does the work of a request. What it throws becomes code and sentence of the reply: `bad_input`,
/// `busy` where another process has the job, `cancelled` while a bag was read, `output_failed`, and
/// `internal_error` for anything else.
std::optional<Failure> failure_of(const std::function<void()>& work);

/// The path of a job that a request names: a bare name, or a path below `directory`. @throws
/// InputError for a path outside of `directory`.
std::string path_in(const std::string& directory, const std::string& result);

}  // namespace codesign
