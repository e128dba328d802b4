// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "description/expression.h"
#include "description/expression_scanner.h"

namespace codesign {

/// A parsed expression as steps of a stack machine.
struct ParsedExpression {
  std::vector<int> dependencies;  ///< the parameters used, ascending
  ExpressionSteps steps;          ///< variable k is parameter dependencies[k]
};

/// Parses an expression. Operators by ascending precedence: `condition ? conditional :
/// conditional`, `or`, `and`, `not`, comparisons of two sums, `+ -`, `* /`, signs, `** ^` (right
/// associative), then numbers, names, calls and parentheses;
/// doc/decisions/0040-expressions-parsed-by-ourselves.md.
/// @throws std::invalid_argument with a sentence that names the error and its position.
ParsedExpression parse_expression(const std::string& text, const ExpressionScope& scope);

}  // namespace codesign
