// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_PROBLEM_MARGINS_H_
#define MECHANISM_CODESIGN_PROBLEM_MARGINS_H_

#include <Eigen/Core>
#include <string>
#include <vector>

#include "description/study.h"

namespace codesign {

/// A constraint counts as met down to this margin: NLopt's algorithms end on a constraint, not inside of it.
constexpr double kMet = -1e-7;

/// The margins of the study's constraints; negative: not met. @param parameters all named parameters.
Eigen::VectorXd constraint_margins(const Study& study, const std::vector<double>& parameters);

/// Whether all are met; one that is not a number is not.
bool all_met(const Eigen::VectorXd& margins);

/// The constraints that are not met with their margins, as a sentence.
std::string describe_unmet(const Study& study, const Eigen::VectorXd& margins);

/// @throws InputError naming the first constraint whose margin is not a number at `parameters`, where a search is to start.
void require_numbers_at_start(const Study& study, const std::vector<double>& parameters);

}  // namespace codesign

#endif  // MECHANISM_CODESIGN_PROBLEM_MARGINS_H_
