// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_DESCRIPTION_PARAMETER_CONSTRAINT_H_
#define MECHANISM_CODESIGN_DESCRIPTION_PARAMETER_CONSTRAINT_H_

#include <string>
#include <vector>

#include "description/study.h"

namespace codesign {

/// Reads `left >= right` or `left <= right`, both sides expressions of the parameters, as a margin that must not be negative.
/// @throws InputError if there is not exactly one such operator outside parentheses, or a side is no expression.
ParameterConstraint parse_constraint(const std::string& text, const std::vector<std::string>& names, const SourceLocation& where,
                                     const std::string& element);

}  // namespace codesign

#endif  // MECHANISM_CODESIGN_DESCRIPTION_PARAMETER_CONSTRAINT_H_
