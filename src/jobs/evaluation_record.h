// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "mechanism_codesign/gradient.h"

namespace codesign {

/// A finished evaluation, the content of a line of a journal.
struct EvaluationRecord {
  int system = 0;                  ///< number of the compiled system, in the order of distinct_systems()
  std::vector<double> parameters;  ///< all named parameters
  Derivatives derivatives = Derivatives::kNone;
  Evaluation evaluation;
};

/// The record as JSON text in one line, without a line end, with its checksum (text/fingerprint.h) as last key. Every double reads back
/// with the same bits; infinity and NaN are texts. Objective and gradient are left out where the status is not ok.
std::string to_line(const EvaluationRecord& record);

/// The record of a line. @throws Json::exception or std::invalid_argument if the line is not a record, or has changed since it was written.
EvaluationRecord read_line(const std::string& line);

}  // namespace codesign
