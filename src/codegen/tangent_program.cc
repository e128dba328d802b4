// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "codegen/tangent_program.h"

#include <algorithm>
#include <utility>

#include "codegen/traced.h"
#include "math/to_index.h"

namespace codesign {
namespace {

/// One term of a derivative: the derivative of `node` times `factor`.
struct Part {
  int node;
  Traced factor;
};
using Parts = std::vector<Part>;

/// The partial derivatives of node n by its operands.
Parts partials(Recording* recording, int n) {
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

bool only_adds(Operation operation) {
  return operation == Operation::kAdd || operation == Operation::kSubtract || operation == Operation::kNegate;
}

/// x, as a literal if its node is one, so that products with it are simplified.
Traced folded(Recording* recording, const Traced& x) {
  if (x.is_literal()) return x;
  const Recording::Node& node = recording->node(x.node_in(recording));
  return node.operation == Operation::kLiteral ? Traced(node.literal) : x;
}

class Accumulation {
 public:
  Accumulation(Recording* recording, const std::vector<ValueTask::Output>& outputs, const std::vector<bool>& is_leaf)
      : recording_(recording),
        outputs_(outputs),
        is_leaf_(is_leaf),
        size_(recording->size()),
        parts_(is_leaf.size()),
        uses_(is_leaf.size(), 0),
        only_added_(is_leaf.size(), true) {}

  void run(TangentProgram* program) {
    program_ = program;
    program->row.assign(is_leaf_.size(), -1);
    find_active();
    count_uses();
    for (int n = 0; n < size_; ++n)
      if (active_[to_index(n)] && uses_[to_index(n)] > 0 && !is_leaf_[to_index(n)]) accumulate(n);
    for (const ValueTask::Output& output : outputs_) append(-1, output, of(output.node, Traced(1.0)));
    std::sort(program->factors.begin(), program->factors.end());
    program->factors.erase(std::unique(program->factors.begin(), program->factors.end()), program->factors.end());
  }

 private:
  void find_active() {
    active_ = is_leaf_;
    for (int n = 0; n < size_; ++n) {
      const Recording::Node& node = recording_->node(n);
      if (active_[to_index(n)] || node.operation == Operation::kLeaf || node.operation == Operation::kLiteral ||
          node.operation == Operation::kRound)
        continue;
      active_[to_index(n)] = active_[to_index(node.a)] || (node.b >= 0 && active_[to_index(node.b)]);
    }
  }

  void count_uses() {
    for (const ValueTask::Output& output : outputs_) ++uses_[to_index(output.node)];
    for (int n = size_ - 1; n >= 0; --n) {
      if (!active_[to_index(n)] || uses_[to_index(n)] == 0 || is_leaf_[to_index(n)]) continue;
      const Recording::Node& node = recording_->node(n);
      for (int operand : {node.a, node.b}) {
        if (operand < 0) continue;
        ++uses_[to_index(operand)];
        if (!only_adds(node.operation)) only_added_[to_index(operand)] = false;
      }
    }
  }

  /// The derivative of `node` times `factor`, in terms of derivatives of leaves and of nodes with a sum.
  Parts of(int node, const Traced& factor) const {
    if (!active_[to_index(node)]) return {};
    if (is_leaf_[to_index(node)] || program_->row[to_index(node)] >= 0) return {{node, factor}};
    Parts parts = parts_[to_index(node)];
    for (Part& part : parts) part.factor = folded(recording_, factor * part.factor);
    return parts;
  }

  void accumulate(int n) {
    Parts sum;
    for (const Part& partial : partials(recording_, n))
      for (const Part& part : of(partial.node, folded(recording_, partial.factor))) add(part, &sum);
    const bool inlined = sum.size() <= 1 || (uses_[to_index(n)] == 1 && only_added_[to_index(n)]);
    if (!inlined) {
      append(n, {}, sum);
      program_->row[to_index(n)] = program_->rows++;
    } else {
      parts_[to_index(n)] = std::move(sum);
    }
  }

  static void add(const Part& part, Parts* sum) {
    for (Part& known : *sum) {
      if (known.node != part.node) continue;
      known.factor += part.factor;
      return;
    }
    sum->push_back(part);
  }

  void append(int node, const ValueTask::Output& output, const Parts& parts) {
    TangentProgram::Sum sum{node, output, {}};
    for (const Part& part : parts) {
      if (part.factor.is_literal() && part.factor.value() == 0.0) continue;
      Traced factor = part.factor;
      const bool negative =
          factor.is_literal() ? factor.value() < 0.0 : recording_->node(factor.node_in(recording_)).operation == Operation::kNegate;
      if (negative) factor = -factor;
      const bool one = factor.is_literal() && factor.value() == 1.0;
      const int factor_node = one ? -1 : factor.node_in(recording_);
      if (!one) program_->factors.push_back(factor_node);
      sum.terms.push_back({part.node, factor_node, !negative});
    }
    program_->sums.push_back(std::move(sum));
  }

  Recording* recording_;
  const std::vector<ValueTask::Output>& outputs_;
  const std::vector<bool>& is_leaf_;
  int size_;  ///< nodes of the recording before those for factors were appended
  TangentProgram* program_ = nullptr;
  std::vector<Parts> parts_;  ///< of nodes without a sum
  std::vector<int> uses_;
  std::vector<bool> only_added_, active_;
};

}  // namespace

TangentProgram::TangentProgram(Recording* recording, const std::vector<ValueTask::Output>& outputs, const std::vector<bool>& is_leaf) {
  Accumulation(recording, outputs, is_leaf).run(this);
}

}  // namespace codesign
