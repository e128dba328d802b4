// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_CLI_JSON_OUTPUT_H_
#define MECHANISM_CODESIGN_CLI_JSON_OUTPUT_H_

#include <Eigen/Core>
#include <nlohmann/json.hpp>
#include <ostream>
#include <string>
#include <vector>

#include "cli/limit_watch.h"
#include "mechanism_codesign/dynamics/counts.h"
#include "mechanism_codesign/dynamics/status.h"
#include "mechanism_codesign/integration/simulation.h"
#include "mechanism_codesign/model/error.h"
#include "mechanism_codesign/optimization/problem.h"

namespace codesign::cli {

/// Keys stay in the order in which they are set.
using Json = nlohmann::ordered_json;

Json to_json(const Counts& counts);
/// `{code, message, file, line, element, value, allowed}` with code `bad_input`.
Json to_json(const InputError& error);
/// `[{joint, limit, bound, worst, time}]`
Json to_json(const std::vector<LimitCrossing>& crossings);
/// `{code, message, time}`
Json to_json(const Status& status);
/// `[{code, message, file, line}]`
Json to_json(const Warnings& warnings);
/// Values by name.
Json by_name(const std::vector<std::string>& names, const std::vector<double>& values);
Json by_name(const std::vector<std::string>& names, const Eigen::VectorXd& values);
/// All named parameters.
Json parameters_json(const Problem& problem, const std::vector<double>& values);
/// Sets `steps`, `rejected_steps`, `cpu_seconds`, `constraint_drift` and `energy_error`.
void add_statistics(const Statistics& statistics, Json* object);
/// Sets `counts`, at `parameters`, unless that design cannot be assembled.
void add_counts(const Problem& problem, const std::vector<double>& parameters, Json* object);

/// One object and a line end. Doubles read back as the same doubles; what is not finite becomes null.
void print(const Json& object, std::ostream& out);
/// The same text. Bytes that are no UTF-8, as a robot's name may hold, become the replacement character.
std::string to_text(const Json& object);

}  // namespace codesign::cli

#endif  // MECHANISM_CODESIGN_CLI_JSON_OUTPUT_H_
