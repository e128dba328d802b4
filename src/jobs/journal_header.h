// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "problem/load_problem.h"

namespace codesign {

/// The first line of a job's journal, without a line end: format, version of this package, fingerprints of everything that determines the
/// evaluations of the job (the texts of model, overlays and study, the trajectories in bags and the files that the study names, the start
/// values, the tuned parameters, and the options of the optimizer), and the checksum of the line (text/fingerprint.h).
std::string journal_header(const Problem& problem, const OptimizerOptions& options);

/// A sentence about the first difference between the header of a journal and the header of this job, such as "the study differs from that
/// of the journal", or about the damage of the line. Empty if they agree. @param found the first line of a file.
std::string header_difference(const std::string& found, const std::string& expected);

}  // namespace codesign
