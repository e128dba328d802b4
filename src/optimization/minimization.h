// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <string>

namespace codesign {

struct OptimizerOptions;
class Scaling;
class SearchTrials;
class SmoothProgram;
struct Study;

/// One attempt of a search by an algorithm of NLopt. An algorithm that ends at a violated bound of
/// a signal goes on from the best point, after the method of moving asymptotes has looked for a
/// point within the bounds.
/// @param options `algorithm` is that of the attempt; the limit counts all evaluations of `trials`.
/// @param scaling of the tuned parameters, which NLopt sees between 0 and 1.
/// @param start values of the tuned parameters.
/// @param trials gets all points, and the termination.
/// @returns why the algorithm failed; empty if it did not.
std::string minimize(const Study& study, const OptimizerOptions& options, const Scaling& scaling,
                     const Eigen::VectorXd& start, SmoothProgram* program, SearchTrials* trials);

}  // namespace codesign
