// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "mechanism_codesign/gradient.h"
#include "problem/load_problem.h"

namespace codesign {

/// The first line of a job's journal, without a line end: format, version of this package,
/// fingerprints of everything that determines the evaluations of the job (the texts of model,
/// overlays and study, the trajectories in bags and the files that the study names, the start
/// values, the tuned parameters, and the options of the optimizer), and the checksum of the line
/// (text/fingerprint.h).
std::string journal_header(const Problem& problem, const OptimizerOptions& options);

/// A sentence about the first difference between the header of a journal and the header of this
/// job, such as "the study differs from that of the journal", or about the damage of the line.
/// Empty if they agree. @param found the first line of a file.
std::string header_difference(const std::string& found, const std::string& expected);

/// A finished evaluation, the content of a line of a journal.
struct EvaluationRecord {
  int system = 0;  ///< number of the compiled system, in the order of distinct_systems()
  std::vector<double> parameters;  ///< all named parameters
  Derivatives derivatives = Derivatives::kNone;
  Evaluation evaluation;
};

/// The record as JSON text in one line, without a line end, with its checksum (text/fingerprint.h)
/// as last key. Every double reads back with the same bits; infinity and NaN are texts. Objective
/// and gradient are left out where the status is not ok.
std::string to_line(const EvaluationRecord& record);

/// The record of a line. @throws Json::exception or std::invalid_argument if the line is not a
/// record, or has changed since it was written.
EvaluationRecord read_line(const std::string& line);

}  // namespace codesign
