// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mechanism_codesign/IdentifyResult.h>
#include <mechanism_codesign/OptimizeResult.h>
#include <mechanism_codesign/WatchedSignal.h>

#include <vector>

#include "identification/fit/identification_result.h"
#include "mechanism_codesign/optimization.h"
#include "problem/load_problem.h"

namespace codesign {

/// Messages for the warnings of the input files, followed by the warnings of a job.
std::vector<mechanism_codesign::Warning> warning_messages(const Warnings& of_files,
                                                          const Warnings& of_job);

/// The warnings of the job alone. @param of_files the number of warnings of the input files, which
/// come first.
Warnings warnings_of_job(const std::vector<mechanism_codesign::Warning>& messages,
                         std::size_t of_files);

/// The message of a result; without job, paths and warnings. @param problem with the request
/// applied.
mechanism_codesign::OptimizeResult optimization_message(const Problem& problem,
                                                        const OptimizationResult& result);

/// Sets the fields of the result about several runs, samples and starts: `scenarios`, `worst`,
/// `value_at_risk`, `validation`, `searches`, `optima`, `screened`, `unusable`. All stay empty for
/// a study with one run and one start. Numbers of samples, scenarios and optima begin at 1 in
/// messages.
void set_ensemble(const OptimizationResult& result, mechanism_codesign::OptimizeResult* message);

/// Messages for the signals with bounds or peaks. @param is_ensemble whether the study has runs or
/// uncertain parameters.
std::vector<mechanism_codesign::WatchedSignal> watched_messages(
    const std::vector<WatchedResult>& watched, bool is_ensemble);

/// The message of a result; without job, paths and warnings. @param problem with the request
/// applied.
mechanism_codesign::IdentifyResult identification_message(const Problem& problem,
                                                          const IdentificationResult& result);

}  // namespace codesign
