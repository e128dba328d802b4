// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "codegen/value_program.h"

#include <algorithm>
#include <map>
#include <utility>

#include "math/arrays.h"

namespace codesign {
namespace {

class Compiler {
 public:
  Compiler(const Recording& recording, const ValueTask& task)
      : recording_(recording),
        task_(task),
        uses_(to_index(recording.size()), 0),
        fixed_(to_index(recording.size()), false),
        stores_(uses_.size()) {
    for (const Recording::Guard& guard : task.guards)
      guards_.emplace(std::max(guard.a, guard.b), guard);
  }

  void run(ValueProgram* program) {
    count_uses();
    program->slot.assign(uses_.size(), -1);
    program->slots = task_.reserved_slots;
    const auto used = uses_.size() - to_index(std::count(uses_.begin(), uses_.end(), 0));
    program->instructions.reserve(used), program->stores.reserve(used);
    for (int n = 0; n < recording_.size(); ++n) {
      if (is_computed(n) && !is_absorbed(n)) {
        program->slot[to_index(n)] = program->slots++;
        append(instruction(n), std::move(stores_[to_index(n)]), program);
      }
      append_guards(n, program);
    }
    for (const ValueTask::Output& output : task_.outputs)
      if (has_home(output.node))
        append({ValueProgram::Kind::kCopy, output.node, output.node, -1, -1}, {output.place},
               program);
  }

 private:
  using Instruction = ValueProgram::Instruction;

  bool has_home(int n) const { return task_.homes[to_index(n)].array >= 0; }
  bool is_computed(int n) const { return uses_[to_index(n)] > 0 && !has_home(n); }

  // From the last node to the first, so that uses by unused nodes are not counted.
  void count_uses() {
    const auto fix = [this](int n) {
      ++uses_[to_index(n)];
      fixed_[to_index(n)] = true;
    };
    for (const ValueTask::Output& output : task_.outputs) {
      fix(output.node);
      if (!has_home(output.node)) stores_[to_index(output.node)].push_back(output.place);
    }
    for (int n : task_.kept) fix(n);
    for (const Recording::Guard& guard : task_.guards) fix(guard.a), fix(guard.b);
    for (int n = recording_.size() - 1; n >= 0; --n) {
      if (!is_computed(n)) continue;
      const Recording::Node& node = recording_.node(n);
      if (node.a >= 0) ++uses_[to_index(node.a)];
      if (node.b >= 0) ++uses_[to_index(node.b)];
    }
  }

  bool is_lone_product(int n) const {
    return recording_.node(n).operation == Operation::kMultiply && !has_home(n) &&
           uses_[to_index(n)] == 1 && !fixed_[to_index(n)];
  }

  /// Which operand of a sum is a product to be fused with it: 1 the first, 2 the second, 0 none.
  int absorbed_operand(int n) const {
    const Recording::Node& node = recording_.node(n);
    if (node.operation != Operation::kAdd && node.operation != Operation::kSubtract) return 0;
    if (is_lone_product(node.b)) return 2;
    return is_lone_product(node.a) ? 1 : 0;
  }

  // A product is fused with its only user, which comes later in the recording.
  bool is_absorbed(int n) {
    if (!is_lone_product(n)) return false;
    if (user_.empty()) find_users();
    const int user = user_[to_index(n)];
    if (user < 0) return false;
    const int operand = absorbed_operand(user);
    return (operand == 1 && recording_.node(user).a == n) ||
           (operand == 2 && recording_.node(user).b == n);
  }

  void find_users() {
    user_.assign(uses_.size(), -1);
    for (int n = 0; n < recording_.size(); ++n) {
      if (!is_computed(n)) continue;
      const Recording::Node& node = recording_.node(n);
      if (node.a >= 0) user_[to_index(node.a)] = n;
      if (node.b >= 0) user_[to_index(node.b)] = n;
    }
  }

  Instruction instruction(int n) const {
    const Recording::Node& node = recording_.node(n);
    const int operand = absorbed_operand(n);
    if (operand == 0) return {ValueProgram::Kind::kOperation, n, node.a, node.b, -1};
    const Recording::Node& product = recording_.node(operand == 1 ? node.a : node.b);
    const int other = operand == 1 ? node.b : node.a;
    const bool minus = node.operation == Operation::kSubtract;
    const ValueProgram::Kind kind = !minus         ? ValueProgram::Kind::kProductPlus
                                    : operand == 1 ? ValueProgram::Kind::kProductMinus
                                                   : ValueProgram::Kind::kMinusProduct;
    return {kind, n, product.a, product.b, other};
  }

  void append_guards(int n, ValueProgram* program) const {
    const auto [first, last] = guards_.equal_range(n);
    for (auto guard = first; guard != last; ++guard)
      append({guard->second.outcome ? ValueProgram::Kind::kGuardLess
                                    : ValueProgram::Kind::kGuardGreaterEqual,
              guard->second.decision, guard->second.a, guard->second.b, -1},
             {}, program);
  }

  static void append(const Instruction& instruction, std::vector<Place> stores,
                     ValueProgram* program) {
    program->instructions.push_back(instruction);
    program->stores.push_back(std::move(stores));
  }

  const Recording& recording_;
  const ValueTask& task_;
  std::vector<int> uses_, user_;
  /// must not be fused, since an output, the caller or a guard needs its value
  std::vector<bool> fixed_;
  std::vector<std::vector<Place>> stores_;
  /// by the later of its two nodes, after which it can be checked
  std::multimap<int, Recording::Guard> guards_;
};

}  // namespace

ValueProgram::ValueProgram(const Recording& recording, const ValueTask& task) {
  Compiler(recording, task).run(this);
}

}  // namespace codesign
