// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "codegen/tangent_program.h"

#include <algorithm>
#include <utility>

#include "codegen/derivatives.h"
#include "math/arrays.h"

namespace codesign {
namespace {

using Parts = std::vector<Partial>;

bool only_adds(Operation operation) {
  return operation == Operation::kAdd || operation == Operation::kSubtract || operation == Operation::kNegate;
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
    for (Partial& part : parts) part.factor = folded(recording_, factor * part.factor);
    return parts;
  }

  void accumulate(int n) {
    Parts sum;
    for (const Partial& partial : partials_of(recording_, n))
      for (const Partial& part : of(partial.node, folded(recording_, partial.factor))) add(part, &sum);
    const bool inlined = sum.size() <= 1 || (uses_[to_index(n)] == 1 && only_added_[to_index(n)]);
    if (!inlined) {
      append(n, {}, sum);
      program_->row[to_index(n)] = program_->rows++;
    } else {
      parts_[to_index(n)] = std::move(sum);
    }
  }

  static void add(const Partial& part, Parts* sum) {
    for (Partial& known : *sum) {
      if (known.node != part.node) continue;
      known.factor += part.factor;
      return;
    }
    sum->push_back(part);
  }

  void append(int node, const ValueTask::Output& output, const Parts& parts) {
    TangentProgram::Sum sum{node, output, {}};
    for (const Partial& part : parts) {
      if (part.factor.is(0.0)) continue;
      Traced factor = part.factor;
      const bool negative =
          factor.is_literal() ? factor.value() < 0.0 : recording_->node(factor.node_in(recording_)).operation == Operation::kNegate;
      if (negative) factor = -factor;
      const bool one = factor.is(1.0);
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
