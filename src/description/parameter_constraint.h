// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "description/study.h"

namespace codesign {

/// Reads `left >= right` or `left <= right`, both sides expressions of the parameters `names`. The margin is left - right or right - left;
/// the constraint holds where it is not negative.
/// @throws InputError if there is not exactly one such operator outside parentheses, if a side is not a valid expression, or if no
/// parameter appears.
ParameterConstraint parse_constraint(const std::string& text, const std::vector<std::string>& names, const SourceLocation& where,
                                     const std::string& element);

/// The constraint `less <= more` between two expressions. @param text its name in messages and results.
/// @throws std::invalid_argument if a side is not a valid expression, or if no parameter appears.
ParameterConstraint make_constraint(const std::string& text, const std::string& less, const std::string& more,
                                    const std::vector<std::string>& names, const SourceLocation& where, const std::string& element);

}  // namespace codesign
