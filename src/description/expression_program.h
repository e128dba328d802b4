// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_DESCRIPTION_EXPRESSION_PROGRAM_H_
#define MECHANISM_CODESIGN_DESCRIPTION_EXPRESSION_PROGRAM_H_

#include <complex>
#include <vector>

namespace codesign {

/// One operation on a stack of numbers; a comparison leaves 1 or 0.
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
    kCall,  ///< function `index` of the topmost `count` numbers
    kLess,
    kLessOrEqual,
    kGreater,
    kGreaterOrEqual,
    kEqual,
    kNotEqual,
    kJumpUnless,  ///< to step `index` if the topmost number, which is taken away, is 0
    kJump         ///< to step `index`
  };
  Code code = Code::kConstant;
  int index = 0;
  int count = 0;
  double number = 0.0;
};

using ExpressionSteps = std::vector<ExpressionStep>;

/// Largest number of numbers that wait for their operation at the same time.
int stack_size(const ExpressionSteps& steps);

/// Carries out the steps. @param variables by index. @param stack room for stack_size() numbers.
std::complex<double> run(const ExpressionSteps& steps, const std::complex<double>* variables, std::complex<double>* stack);

}  // namespace codesign

#endif  // MECHANISM_CODESIGN_DESCRIPTION_EXPRESSION_PROGRAM_H_
