// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "codegen/recording.h"

namespace codesign {

/// The place of a number: an index into one of the arrays that compiled code works on. Absent if
/// array < 0.
struct Place {
  int array = -1, index = 0;

  friend bool operator==(const Place& x, const Place& y) {
    return x.array == y.array && x.index == y.index;
  }
};

/// The number of arrays that compiled code can address.
constexpr int kCodeArrays = 11;

/// Which values of a recording to compute, where to read its leaves and where to write its outputs.
struct ValueTask {
  struct Output {
    int node;
    Place place;
  };
  std::vector<Output> outputs;
  std::vector<int> kept;  ///< nodes whose values the caller reads from their slots afterwards
  /// per node: the place that already has its value; absent if it is to be computed
  std::vector<Place> homes;
  std::vector<Recording::Guard> guards;  ///< that must hold for the outputs to be valid
  int reserved_slots = 0;  ///< slots before the slots of the program, which does not change them
};

/// A task as a list of instructions in order. Nodes that no output, kept node or guard needs are
/// left out; a product that is used once, in a sum, becomes one fused instruction with it.
struct ValueProgram {
  enum class Kind {
    kOperation,         ///< the operation of the recording's node on a and b
    kProductPlus,       ///< a b + c
    kProductMinus,      ///< a b - c
    kMinusProduct,      ///< c - a b
    kCopy,              ///< copies a, a node with a home that is also an output
    kGuardLess,         ///< the program fails unless a < b
    kGuardGreaterEqual  ///< the program fails if a < b
  };
  struct Instruction {
    Kind kind;
    int node;     ///< the result, a node of the recording; of a guard its Guard::decision
    int a, b, c;  ///< the operands, nodes of the recording; -1 if unused
  };

  ValueProgram(const Recording& recording, const ValueTask& task);

  std::vector<Instruction> instructions;
  std::vector<std::vector<Place>> stores;  ///< per instruction: the places of its result
  /// per node: its index in the array of intermediate values, -1 if not computed
  std::vector<int> slot;
  int slots = 0;  ///< size of that array, reserved slots included
};

}  // namespace codesign
