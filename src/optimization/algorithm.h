// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <nlopt.hpp>
#include <string>
#include <vector>

#include "description/ensemble.h"

namespace codesign {

struct Study;
struct OptimizerOptions;

/// The place of the options, for messages; the study's first line if the options do not come from a
/// file.
SourceLocation where_of(const OptimizerOptions& options, const Study& study);

/// Whether the algorithm is Levenberg-Marquardt, which minimizes sums of squares; else it is one of
/// NLopt's.
bool is_least_squares(const std::string& algorithm);

/// @param study gives the constraints. @param with_slack whether slack variables of a robust
/// measure add constraints.
/// @throws InputError for an unknown algorithm, for constraints with an algorithm that takes none,
/// or a relative tolerance out of range.
void check_algorithm(const Study& study, const OptimizerOptions& options, bool with_slack);
/// For Levenberg-Marquardt. @param measure of the objectives of several scenarios; kMean if there
/// is one.
/// @throws InputError if the objective is no sum of squares, or its residuals have no derivatives.
void check_squares(const Study& study, const OptimizerOptions& options, RobustMeasure measure);

/// The algorithms with which a search goes on in turn, until one ends at an optimum: the one that
/// is named, or for `auto` those that prove best (doc/performance.md) and take the problem. @param
/// with_slack, measure as above.
std::vector<std::string> algorithms_for(const Study& study, const OptimizerOptions& options,
                                        RobustMeasure measure, bool with_slack);
/// Whether the algorithm reads gradients; one that does not has no use for conditions on them.
bool uses_gradients(const std::string& algorithm);
/// Whether the objective is a sum of squares over one time beside its peaks: the end of a run does
/// not depend on the design, no weight is a negative number, all losses are squares, and no measure
/// of a signal is a term of its own, theory (21e).
bool is_sum_of_squares(const Study& study);

/// The NLopt optimizer that `options.algorithm` names. @param options checked, and neither `auto`
/// nor for least squares. @param dimension number of tuned parameters and slack variables.
nlopt::opt make_optimizer(const OptimizerOptions& options, unsigned dimension);

/// Whether a termination says that the search converged.
bool is_success(const std::string& termination);

/// Snake-case name of the reason for which NLopt stopped, e.g. objective_tolerance_reached.
std::string termination_name(nlopt::result result);

}  // namespace codesign
