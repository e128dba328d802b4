// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "description/expression_range.h"

#include <algorithm>
#include <cmath>

namespace codesign {
namespace {

using Code = ExpressionStep::Code;

/// The range of four products or quotients of ends; all numbers if one is undefined, such as 0 * infinity.
ValueRange hull(std::initializer_list<double> ends) {
  if (std::any_of(ends.begin(), ends.end(), [](double end) { return std::isnan(end); })) return {};
  return {std::min(ends), std::max(ends)};
}

ValueRange combine(Code code, const ValueRange& a, const ValueRange& b) {
  switch (code) {
    case Code::kAdd:
      return hull({a.lower + b.lower, a.upper + b.upper});
    case Code::kSubtract:
      return hull({a.lower - b.upper, a.upper - b.lower});
    case Code::kMultiply:
      return hull({a.lower * b.lower, a.lower * b.upper, a.upper * b.lower, a.upper * b.upper});
    default:
      if (b.lower <= 0.0 && b.upper >= 0.0) return {};
      return hull({a.lower / b.lower, a.lower / b.upper, a.upper / b.lower, a.upper / b.upper});
  }
}

}  // namespace

ValueRange range_of(const ExpressionSteps& steps, In<ValueRange> variables) {
  std::vector<ValueRange> stack;
  for (const ExpressionStep& step : steps) {
    switch (step.code) {
      case Code::kConstant:
        stack.push_back({step.number, step.number});
        break;
      case Code::kVariable:
        stack.push_back(variables[step.index]);
        break;
      case Code::kNegate:
        stack.back() = {-stack.back().upper, -stack.back().lower};
        break;
      case Code::kAdd:
      case Code::kSubtract:
      case Code::kMultiply:
      case Code::kDivide: {
        const ValueRange right = stack.back();
        stack.pop_back();
        stack.back() = combine(step.code, stack.back(), right);
        break;
      }
      default:
        return {};
    }
  }
  return stack.back();
}

}  // namespace codesign
