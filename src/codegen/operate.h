// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>

#include "codegen/recording.h"
#include "math/elementary.h"

namespace codesign {

/// The result of one operation of a Recording. @param b ignored by operations with one operand. For kLeaf and kLiteral, which do not
/// compute anything, the result is a.
template <class T>
T operate(Operation operation, const T& a, const T& b) {
  using std::asin, std::cos, std::exp, std::sin, std::sqrt, std::tanh;
  switch (operation) {
    case Operation::kAdd:
      return a + b;
    case Operation::kSubtract:
      return a - b;
    case Operation::kMultiply:
      return a * b;
    case Operation::kDivide:
      return a / b;
    case Operation::kNegate:
      return -a;
    case Operation::kSquareRoot:
      return sqrt(a);
    case Operation::kRound:
      return T(std::nearbyint(value_of(a)));
    case Operation::kTanh:
      return tanh(a);
    case Operation::kExp:
      return exp(a);
    case Operation::kSin:
      return sin(a);
    case Operation::kCos:
      return cos(a);
    case Operation::kArcSine:
      return asin(a);
    case Operation::kArcTangent:
      return arc_tangent(a, b);
    case Operation::kLeaf:
    case Operation::kLiteral:
      break;
  }
  return a;
}

}  // namespace codesign
