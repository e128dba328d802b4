// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_MODEL_EXPRESSION_FUNCTIONS_H_
#define MECHANISM_CODESIGN_MODEL_EXPRESSION_FUNCTIONS_H_

#include <muparserx/mpParser.h>

namespace codesign {

/// Installs operators, functions and `pi` into a bare parser. All of them carry a complex step through to first order: those that are not
/// analytic (abs, min, max, comparisons, floor, ...) decide by the real part.
void install_expression_functions(mup::ParserX* parser);

}  // namespace codesign

#endif  // MECHANISM_CODESIGN_MODEL_EXPRESSION_FUNCTIONS_H_
