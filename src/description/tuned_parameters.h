// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "description/study.h"

namespace codesign {

/// Reads `left >= right`, `left <= right` or `left == right`, both sides expressions of the
/// parameters `names`. The margin is left - right of the first, else right - left; the constraint
/// holds where it is not negative, an equality where it is zero.
/// @throws InputError if there is not exactly one such operator outside parentheses, if a side is
/// not a valid expression, or if no parameter appears.
ParameterConstraint parse_constraint(const std::string& text, const std::vector<std::string>& names,
                                     const SourceLocation& where, const std::string& element);

/// The constraint `less <= more` between two expressions. @param text its name in messages and
/// results.
/// @throws std::invalid_argument if a side is not a valid expression, or if no parameter appears.
ParameterConstraint make_constraint(const std::string& text, const std::string& less,
                                    const std::string& more, const std::vector<std::string>& names,
                                    const SourceLocation& where, const std::string& element);

/// Start values of all named parameters, in the order of Study::parameters.
std::vector<double> start_parameters(const MotionStudy& study);

/// All named parameters, in the order of Study::parameters: the tuned ones from `rho` (p entries,
/// order of Study::tuned), the others at their start values.
std::vector<double> parameters_at(const MotionStudy& study, const Eigen::VectorXd& rho);
/// The same. @param values overwritten, its memory is used again.
void parameters_at(const MotionStudy& study, const Eigen::VectorXd& rho,
                   std::vector<double>* values);

/// The start of rho: the start values of the p tuned parameters, in the order of Study::tuned.
Eigen::VectorXd start_of(const MotionStudy& study);

/// Checks that the study has something to tune. @throws InputError if not.
void require_tuned(const Study& study);

/// The first controller of a study or of one of its runs that rounds its input, theory (51);
/// nullptr if there is none.
const ControllerDescription* find_rounded(const Study& study);

/// Checks that nothing is rounded, so that there are derivatives. @throws InputError if something
/// is. Part of require_tuned().
void require_differentiable(const Study& study);

/// Whether both bounds are finite and differ.
bool has_range(const Parameter& parameter);
/// The range of a parameter between its bounds; where one is missing, the magnitude of its start or
/// of `value`, whichever is larger.
double extent(const Parameter& parameter, double value);

/// `[lower, upper]`, the bounds of a parameter as messages show them.
std::string range_of(const Parameter& parameter);

/// The error for a tuned parameter in a place where tuned parameters are not allowed. @param
/// element the path of the place.
InputError tuned_error(const SourceLocation& where, const std::string& element,
                       const std::string& name);

/// The fault of a tuned parameter without two finite bounds, between which many starts are drawn;
/// std::nullopt if it has them.
std::optional<InputFault> find_missing_bounds(const Parameter& parameter);

/// The parameter of entry k of rho.
const Parameter& tuned_parameter(const MotionStudy& study, Eigen::Index k);

/// A row of a list to choose from: its label, or its numbers.
std::string row_text(const ParameterChoice& choice, std::size_t row);
/// The place in rho of each parameter of a choice. @throws InputError if some of them are not
/// tuned; empty if none is
std::vector<Eigen::Index> places_of(const ParameterChoice& choice, const Study& study);

/// Names of the tuned parameters, in the order of rho.
std::vector<std::string> tuned_names(const MotionStudy& study);

}  // namespace codesign
