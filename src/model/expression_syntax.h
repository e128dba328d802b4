// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_MODEL_EXPRESSION_SYNTAX_H_
#define MECHANISM_CODESIGN_MODEL_EXPRESSION_SYNTAX_H_

#include <string>
#include <vector>

namespace codesign {

/// Names with a meaning of their own inside an expression.
const std::vector<std::string>& expression_functions();

/// Checks what the parser library would accept but should not (unknown names, strings, assignments, `3k`), with better messages.
/// @returns the indices in `names` of the parameters used, ascending.
/// @throws std::invalid_argument with a sentence.
std::vector<int> scan_expression(const std::string& text, const std::vector<std::string>& names);

}  // namespace codesign

#endif  // MECHANISM_CODESIGN_MODEL_EXPRESSION_SYNTAX_H_
