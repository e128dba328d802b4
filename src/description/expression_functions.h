// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <complex>
#include <string>
#include <vector>

#include "math/span.h"

namespace codesign {

constexpr double kPi = 3.14159265358979323846;

/// A function that expressions may call. All functions propagate a complex step exactly to first order; those that are not analytic (abs,
/// min, max, floor, ...) branch by the real part.
struct ExpressionFunction {
  using Law = std::complex<double> (*)(In<std::complex<double>> arguments);
  const char* name;
  int count;  ///< number of arguments; -1: one or more
  Law law;
};

/// All functions. The table never changes, so that indices into it stay valid.
const std::vector<ExpressionFunction>& expression_function_table();

/// Index of a function, -1 if there is none of this name.
int find_expression_function(const std::string& name);

/// z[0] to the power of z[1].
std::complex<double> expression_power(In<std::complex<double>> z);

/// a / b. Real numbers are divided as doubles, infinities and NaN included.
std::complex<double> expression_quotient(std::complex<double> a, std::complex<double> b);

}  // namespace codesign
