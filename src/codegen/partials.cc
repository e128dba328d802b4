// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "codegen/partials.h"

namespace codesign {

std::vector<Partial> partials_of(Recording* recording, int n) {
  const Recording::Node node = recording->node(n);
  const auto value = [recording](int k) { return Traced(recording, k); };
  const Traced self = value(n), one(1.0);
  switch (node.operation) {
    case Operation::kAdd:
      return {{node.a, one}, {node.b, one}};
    case Operation::kSubtract:
      return {{node.a, one}, {node.b, -one}};
    case Operation::kMultiply:
      return {{node.a, value(node.b)}, {node.b, value(node.a)}};
    case Operation::kDivide: {
      const Traced inverse = one / value(node.b);
      return {{node.a, inverse}, {node.b, -(self * inverse)}};
    }
    case Operation::kNegate:
      return {{node.a, -one}};
    case Operation::kSquareRoot:
      return {{node.a, Traced(0.5) / self}};
    case Operation::kTanh:
      return {{node.a, one - self * self}};
    case Operation::kExp:
      return {{node.a, self}};
    case Operation::kSin:
      return {{node.a, cos(value(node.a))}};
    case Operation::kCos:
      return {{node.a, -sin(value(node.a))}};
    case Operation::kArcSine:
      return {{node.a, one / sqrt(one - value(node.a) * value(node.a))}};
    case Operation::kArcTangent: {
      const Traced y = value(node.a), x = value(node.b), inverse = one / (x * x + y * y);
      return {{node.a, x * inverse}, {node.b, -(y * inverse)}};
    }
    default:
      return {};
  }
}

Traced folded(Recording* recording, const Traced& x) {
  if (x.is_literal()) return x;
  const Recording::Node& node = recording->node(x.node_in(recording));
  return node.operation == Operation::kLiteral ? Traced(node.literal) : x;
}

Traced product(Recording* recording, const Traced& x, const Traced& y) {
  const auto varies = [recording](const Traced& z) { return !z.is_literal() && recording->node(z.node()).varies; };
  if (varies(x) == varies(y)) return folded(recording, x * y);
  const Traced &fixed = varies(x) ? y : x, &moving = varies(x) ? x : y;
  const Recording::Node node = recording->node(moving.node());
  if (node.operation == Operation::kMultiply && recording->node(node.a).varies != recording->node(node.b).varies) {
    const bool first = recording->node(node.a).varies;
    const Traced inner(recording, first ? node.b : node.a), rest(recording, first ? node.a : node.b);
    return folded(recording, (fixed * folded(recording, inner)) * rest);
  }
  return folded(recording, x * y);
}

}  // namespace codesign
