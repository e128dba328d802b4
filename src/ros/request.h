// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_ROS_REQUEST_H_
#define MECHANISM_CODESIGN_ROS_REQUEST_H_

#include <mechanism_codesign/EvaluateRequest.h>
#include <mechanism_codesign/OptimizeGoal.h>

#include <Eigen/Core>
#include <string>
#include <vector>

#include "problem/load_problem.h"

namespace codesign {

/// Refuses lists that no request can mean, before anything copies them or looks for names. @throws InputError naming the field.
/// @param values_field the name of the field that holds `values`.
void check_size(const Problem& problem, const std::vector<std::string>& names, const std::vector<double>& values,
                const std::string& values_field);

/// What a request asks for: the loaded problem, with other parameters to tune or other starts where it names some, and the options of the
/// optimizer.
struct OptimizationRequest {
  Problem problem;
  OptimizerOptions options;
};

/// @throws InputError naming the field of the request.
OptimizationRequest apply_request(const Problem& problem, const mechanism_codesign::OptimizeGoal& request);

/// The design an evaluation asks for: the study's start, with the parameters of the request at their values.
/// @throws InputError naming the field of the request.
Eigen::VectorXd design_of(const Problem& problem, const mechanism_codesign::EvaluateRequest& request);

}  // namespace codesign

#endif  // MECHANISM_CODESIGN_ROS_REQUEST_H_
