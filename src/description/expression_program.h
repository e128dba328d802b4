// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <complex>
#include <vector>

#include "math/span.h"

namespace codesign {

/// One operation of a stack machine on numbers. Operators replace their operands on the stack by the result; comparisons give 1 or 0.
struct ExpressionStep {
  enum class Code : unsigned char {
    kConstant,  ///< pushes `number`
    kVariable,  ///< pushes variable `index`
    kNegate,
    kAdd,
    kSubtract,
    kMultiply,
    kDivide,
    kPower,
    kCall,  ///< replaces the topmost `count` numbers by function `index` of them
    kLess,
    kLessOrEqual,
    kGreater,
    kGreaterOrEqual,
    kEqual,
    kNotEqual,
    kJumpUnless,  ///< removes the topmost number and goes to step `index` if it is 0
    kJump         ///< goes to step `index`
  };
  Code code = Code::kConstant;
  int index = 0;
  int count = 0;
  double number = 0.0;
};

using ExpressionSteps = std::vector<ExpressionStep>;

/// An upper bound of the numbers on the stack at any time.
int stack_size(const ExpressionSteps& steps);

/// Executes the steps and returns the result. @param variables their values, by index. @param stack memory for stack_size() numbers.
std::complex<double> run(const ExpressionSteps& steps, In<std::complex<double>> variables, Out<std::complex<double>> stack);

}  // namespace codesign
