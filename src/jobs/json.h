// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <nlohmann/json.hpp>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "problem/load_problem.h"

namespace codesign {

/// A JSON object that keeps its keys in the order in which they are set. Declared only: whoever
/// reads or makes one includes jobs/json.h, which takes seconds to compile.
using Json = nlohmann::ordered_json;

/// An object with one number per name; if the lists differ in length, the rest of the longer list
/// is left out.
Json by_name(const std::vector<std::string>& names, const std::vector<double>& values);
Json by_name(const std::vector<std::string>& names, const Eigen::VectorXd& values);

/// The rows of a matrix, each a list of numbers.
Json rows_json(const Eigen::MatrixXd& matrix);

/// An object with the value of every named parameter. @param values order of
/// Problem::all_parameters().
Json parameters_json(const Problem& problem, const std::vector<double>& values);

/// The object as indented JSON text with a final line end. The first key is `version`, the version
/// of this package. Doubles are written so that they read back as the same doubles; NaN and
/// infinity become null. Bytes that are not UTF-8, which names in a model may contain, become the
/// replacement character U+FFFD.
std::string to_text(const Json& object);

}  // namespace codesign
