// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
// What code reads as inputs, which decisions it checks, and the code for values.
#include <algorithm>
#include <utility>

#include "equations/equation_recorder.h"
#include "equations/equation_variant.h"
#include "math/arrays.h"

namespace codesign {
namespace {

using Arrays = EquationArrays;

/// Whether a node is an entry of kNumbers: it depends on design, time or a turn reference, not on
/// the state.
bool is_number(const Recording::Node& node) {
  return !node.varies || (node.operation == Operation::kLeaf && node.a >= Recording::kSupplied);
}

}  // namespace

void NumberedRecording::number_nodes() {
  functions.resize(recording.timed_sources().size());
  for (auto& orders : functions) orders.fill(-1);
  homes.resize(to_index(recording.size()));
  std::vector<bool> used(homes.size());
  for (int n = 0; n < recording.size(); ++n) {
    const Recording::Node& node = recording.node(n);
    if (node.operation == Operation::kLeaf) continue;
    for (int operand : {node.a, node.b})
      if (operand >= 0) used[to_index(operand)] = true;
  }
  for (int n = 0; n < recording.size(); ++n) {
    const Recording::Node& node = recording.node(n);
    if (!is_number(node)) {
      if (node.operation == Operation::kLeaf) homes[to_index(n)] = {node.a, node.b};
      continue;
    }
    const auto entry = static_cast<int>(numbers.size());
    homes[to_index(n)] = {Arrays::kNumbers, entry};
    numbers.push_back(n);
    if (node.operation != Operation::kLeaf) continue;
    if (node.a == Recording::kTimed)
      functions[to_index(node.b / Recording::kFunctionOrders)]
               [to_index(node.b % Recording::kFunctionOrders)] = entry;
    if (node.a == EquationRecorder::kTurns && used[to_index(n)]) turns.push_back({node.b, entry});
  }
}

std::unique_ptr<CompiledFunction> compile_values(const Recording& recording, const ValueTask& task,
                                                 const ValueProgram& program, bool interpreted) {
  auto compiled = std::make_unique<CompiledFunction>();
  compiled->slots = to_index(program.slots);
  if (!interpreted) compiled->values = ValueCode::compile(recording, task, program, Arrays::kSlots);
  if (compiled->values) return compiled;
  auto interpreter = std::make_unique<Interpreter>(recording, task, program, Arrays::kSlots);
  compiled->interpreter = interpreter.get();
  compiled->values = std::move(interpreter);
  return compiled;
}

std::vector<Recording::Guard> checked(std::vector<Recording::Guard> guards, bool held) {
  if (held)
    guards.erase(std::remove_if(guards.begin(), guards.end(),
                                [](const Recording::Guard& guard) { return guard.is_switch; }),
                 guards.end());
  return guards;
}

}  // namespace codesign
