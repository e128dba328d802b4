// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_OPTIMIZATION_ALGORITHM_H_
#define MECHANISM_CODESIGN_OPTIMIZATION_ALGORITHM_H_

#include <nlopt.hpp>
#include <string>

#include "description/study.h"

namespace codesign {

/// Where the options stand; the study's first line if they come from elsewhere.
SourceLocation where_of(const OptimizerOptions& options, const Study& study);

/// The NLopt optimizer that `options.algorithm` names. @param study for its parameter constraints. @param dimension number of tuned
/// parameters and slack variables. @param with_slack whether slack variables add constraints.
/// @throws InputError for an unknown algorithm, for constraints with an algorithm that takes none, or a relative tolerance out of range.
nlopt::opt make_optimizer(const Study& study, const OptimizerOptions& options, unsigned dimension, bool with_slack = false);

/// Snake-case name of the reason for which NLopt stopped, e.g. objective_tolerance_reached.
std::string termination_name(nlopt::result result);

}  // namespace codesign

#endif  // MECHANISM_CODESIGN_OPTIMIZATION_ALGORITHM_H_
