// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_DESCRIPTION_EXPRESSION_FUNCTIONS_H_
#define MECHANISM_CODESIGN_DESCRIPTION_EXPRESSION_FUNCTIONS_H_

#include <complex>
#include <string>
#include <vector>

namespace codesign {

/// A function of an expression. All of them carry a complex step through to first order: those that are not analytic (abs, min, max, floor,
/// ...) decide by the real part.
struct ExpressionFunction {
  using Law = std::complex<double> (*)(const std::complex<double>* arguments, int count);
  const char* name;
  int count;  ///< of arguments; -1: one or more
  Law law;
};

/// All functions; an index into them stays valid.
const std::vector<ExpressionFunction>& expression_function_table();

/// Index of a function, -1 if there is none of this name.
int find_expression_function(const std::string& name);

/// base ^ exponent, z = {base, exponent}.
std::complex<double> expression_power(const std::complex<double>* z, int count);

/// a / b; of real numbers the same as for doubles.
std::complex<double> expression_quotient(std::complex<double> a, std::complex<double> b);

}  // namespace codesign

#endif  // MECHANISM_CODESIGN_DESCRIPTION_EXPRESSION_FUNCTIONS_H_
