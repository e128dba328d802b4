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

/// The object as JSON text with a line end, and before its own keys `version`, the version of this package. Doubles read back as the same
/// doubles; NaN and infinity become null. Bytes that are not UTF-8, which a robot's name may hold, become the replacement character U+FFFD.
std::string to_text(const Json& object);

}  // namespace codesign

#endif  // MECHANISM_CODESIGN_JOBS_JSON_H_
