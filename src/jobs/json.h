// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "jobs/json_type.h"
#include "problem/load_problem.h"

namespace codesign {

/// An object with one number per name; if the lists differ in length, the rest of the longer list is left out.
Json by_name(const std::vector<std::string>& names, const std::vector<double>& values);
Json by_name(const std::vector<std::string>& names, const Eigen::VectorXd& values);

/// An object with the value of every named parameter. @param values order of Problem::all_parameters().
Json parameters_json(const Problem& problem, const std::vector<double>& values);

/// The object as indented JSON text with a final line end. The first key is `version`, the version of this package. Doubles are written so
/// that they read back as the same doubles; NaN and infinity become null. Bytes that are not UTF-8, which names in a model may contain,
/// become the replacement character U+FFFD.
std::string to_text(const Json& object);

}  // namespace codesign
