// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_JOBS_JSON_H_
#define MECHANISM_CODESIGN_JOBS_JSON_H_

#include <Eigen/Core>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "problem/load_problem.h"

namespace codesign {

/// Keys stay in the order in which they are set.
using Json = nlohmann::ordered_json;

/// Values by name.
Json by_name(const std::vector<std::string>& names, const std::vector<double>& values);
Json by_name(const std::vector<std::string>& names, const Eigen::VectorXd& values);

/// All named parameters.
Json parameters_json(const Problem& problem, const std::vector<double>& values);

/// One object and a line end. Doubles read back as the same doubles; what is not finite becomes null. Bytes that are no UTF-8, as a robot's
/// name may hold, become the replacement character.
std::string to_text(const Json& object);

}  // namespace codesign

#endif  // MECHANISM_CODESIGN_JOBS_JSON_H_
