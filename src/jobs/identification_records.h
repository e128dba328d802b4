// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "identification/identification_result.h"
#include "jobs/json_type.h"
#include "mechanism_codesign/warning.h"
#include "problem/load_problem.h"

namespace codesign {

/// identification.json, doc/study.md: `identified` (by name: value, start, deviation, interval, ...), `undetermined`, `covariance`,
/// `correlation`, `data` and `holdout` (residuals by joint), `parameters`, `termination` and counts. Infinite and unknown numbers are null.
Json identification_json(const Problem& problem, const IdentificationResult& result);

/// The same as text, with the outcome that add_outcome() adds.
std::string identification_report(const Problem& problem, const IdentificationResult& result, const Warnings& of_run);

/// A summary for people, one sentence per line: whether the holdout is explained, which numbers the data do not determine, residuals by
/// joint.
std::vector<std::string> identification_sentences(const IdentificationResult& result);

/// Columns and rows of residuals.csv: set (data or holdout), recording (from 1), time [s], then per joint JOINT/recorded and
/// JOINT/computed.
std::vector<std::string> residual_columns(const IdentificationResult& result);
std::vector<std::vector<std::string>> residual_rows(const IdentificationResult& result);

}  // namespace codesign
