// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_CODEGEN_VALUE_PROGRAM_H_
#define MECHANISM_CODESIGN_CODEGEN_VALUE_PROGRAM_H_

#include <vector>

#include "codegen/machine_code.h"
#include "codegen/recording.h"

namespace codesign {

/// What a recording is to compute, and where it finds and leaves it.
struct ValueTask {
  struct Output {
    int node;
    Place place;
  };
  std::vector<Output> outputs;
  std::vector<int> kept;     ///< nodes whose values must be found in their slots afterwards
  std::vector<Place> homes;  ///< per node: where its value comes from; none if it is to be computed
  std::vector<Recording::Guard> guards;
  int reserved_slots = 0;  ///< before those of the program
};

/// A task as a list of instructions in order: what no output needs is left out, and products that only one sum uses are part of it.
struct ValueProgram {
  enum class Kind {
    kOperation,         ///< the node's own
    kProductPlus,       ///< a b + c
    kProductMinus,      ///< a b - c
    kMinusProduct,      ///< c - a b
    kCopy,              ///< an output that is not computed here: a
    kGuardLess,         ///< leaves unless a < b
    kGuardGreaterEqual  ///< leaves if a < b
  };
  struct Instruction {
    Kind kind;
    int node, a, b, c;  ///< -1 where there is none
  };

  ValueProgram(const Recording& recording, const ValueTask& task);

  std::vector<Instruction> instructions;
  std::vector<std::vector<Place>> stores;  ///< per instruction: where its result goes
  std::vector<int> slot;                   ///< per node: its place in the array of intermediate values, -1 if not computed
  int slots = 0;                           ///< with the reserved ones
};

}  // namespace codesign

#endif  // MECHANISM_CODESIGN_CODEGEN_VALUE_PROGRAM_H_
