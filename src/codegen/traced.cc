// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "codegen/traced.h"

#include <cmath>

#include "codegen/interpreter.h"

namespace codesign {
namespace {

Traced record(Operation operation, const Traced& x) {
  return {x.recording(), x.recording()->operate(operation, x.node()),
          operate(operation, x.value(), 0.0)};
}

Traced record(Operation operation, const Traced& x, const Traced& y) {
  Recording* const recording = x.is_literal() ? y.recording() : x.recording();
  const int a = x.is_literal() ? recording->literal(x.value()) : x.node(),
            b = y.is_literal() ? recording->literal(y.value()) : y.node();
  return {recording, recording->operate(operation, a, b), operate(operation, x.value(), y.value())};
}

bool is_negated(const Traced& x) {
  return !x.is_literal() && x.recording()->node(x.node()).operation == Operation::kNegate;
}

Traced without_sign(const Traced& x) {
  return {x.recording(), x.recording()->node(x.node()).a, -x.value()};
}

Traced apply(Operation operation, const Traced& x) {
  return x.is_literal() ? Traced(operate(operation, x.value(), 0.0)) : record(operation, x);
}

}  // namespace

Traced operator-(const Traced& x) {
  if (x.is_literal()) return {-x.value_};
  return is_negated(x) ? without_sign(x) : record(Operation::kNegate, x);
}

Traced operator+(const Traced& x, const Traced& y) {
  if (x.is_literal() && y.is_literal()) return {x.value_ + y.value_};
  if (x.is(0.0)) return y;
  if (y.is(0.0)) return x;
  if (is_negated(y)) return x - without_sign(y);
  if (is_negated(x)) return y - without_sign(x);
  return record(Operation::kAdd, x, y);
}

Traced operator-(const Traced& x, const Traced& y) {
  if (x.is_literal() && y.is_literal()) return {x.value_ - y.value_};
  if (x.is(0.0)) return -y;
  if (y.is(0.0)) return x;
  if (!x.is_literal() && !y.is_literal() && x.node_ == y.node_) return {0.0};
  if (is_negated(y)) return x + without_sign(y);
  return record(Operation::kSubtract, x, y);
}

Traced operator*(const Traced& x, const Traced& y) {
  if (x.is_literal() && y.is_literal()) return {x.value_ * y.value_};
  if (y.is_literal()) return y * x;
  if (x.is(0.0)) return {0.0};
  if (x.is(1.0)) return y;
  if (x.is_literal() && x.value_ < 0.0) return -(Traced(-x.value_) * y);
  if (is_negated(x)) return -(without_sign(x) * y);
  if (is_negated(y)) return -(x * without_sign(y));
  return record(Operation::kMultiply, x, y);
}

Traced operator/(const Traced& x, const Traced& y) {
  if (x.is_literal() && y.is_literal()) return {x.value_ / y.value_};
  if (x.is(0.0)) return {0.0};
  if (y.is_literal()) return Traced(1.0 / y.value_) * x;
  return record(Operation::kDivide, x, y);
}

Traced sqrt(const Traced& x) { return apply(Operation::kSquareRoot, x); }
Traced sin(const Traced& x) { return apply(Operation::kSin, x); }
Traced cos(const Traced& x) { return apply(Operation::kCos, x); }
Traced asin(const Traced& x) { return apply(Operation::kArcSine, x); }
Traced tanh(const Traced& x) { return apply(Operation::kTanh, x); }
Traced exp(const Traced& x) { return apply(Operation::kExp, x); }
Traced log(const Traced& x) { return apply(Operation::kLog, x); }
Traced round(const Traced& x) { return apply(Operation::kRound, x); }
Traced atan2(const Traced& y, const Traced& x) {
  if (x.is_literal() && y.is_literal()) return {std::atan2(y.value(), x.value())};
  return record(Operation::kArcTangent, y, x);
}

double value_of(const Traced& x) {
  if (x.is_literal()) return x.value();
  x.recording()->refuse();
  return 0.0;
}

namespace {

bool decide(const Traced& x, const Traced& y, bool likely, unsigned place, DecisionKind kind) {
  if (x.is_literal() && y.is_literal()) return x.value() < y.value();
  Recording* const recording = x.is_literal() ? y.recording() : x.recording();
  const int a = x.node_in(recording), b = y.node_in(recording);
  const bool varies = recording->node(a).varies || recording->node(b).varies;
  return recording->decide(a, b, varies ? likely : x.value() < y.value(), place, kind);
}

}  // namespace

bool is_less(const Traced& x, const Traced& y, bool likely, unsigned place) {
  return decide(x, y, likely, place, DecisionKind::kSmooth);
}

bool is_below(const Traced& x, const Traced& y, bool likely, unsigned place) {
  return decide(x, y, likely, place, DecisionKind::kSwitch);
}

bool is_below_kink(const Traced& x, const Traced& y, bool likely, unsigned place) {
  return decide(x, y, likely, place, DecisionKind::kKink);
}

// Bisection between a power of two and the next one. Beyond the last one it is the number.
Traced whole_below(const Traced& x) {
  constexpr double kLast = 1 << 30;
  if (x.is_literal()) return std::floor(x.value());
  double low = 0.0, high = 1.0;
  if (is_below(x, 0.0, false)) {
    for (low = -1.0, high = 0.0; low > -kLast && is_below(x, low, false); low *= 2.0) high = low;
  } else {
    for (; high < kLast && !is_below(x, high, true); high *= 2.0) low = high;
  }
  while (high - low > 1.0) {
    const double middle = 0.5 * (low + high);
    (is_below(x, middle, true) ? high : low) = middle;
  }
  return low;
}

}  // namespace codesign
