// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <memory>

#include "codegen/value_program.h"

namespace codesign {

/// A ValueProgram compiled into machine code without loops. If registers run out, the value whose
/// next use is farthest away is moved to memory (Belady's rule).
class ValueCode {
 public:
  using Arrays = std::array<const double*, kCodeArrays>;  ///< addresses, as MachineCode loads them

  virtual ~ValueCode() = default;

  /// Whether this processor can run compiled code.
  static bool is_available();

  /// Returns null where compiled code cannot run (see StraightLine::compile()), or if an upper
  /// estimate of its size exceeds 16 MB.
  /// @param slot_array the array for intermediate values, of ValueProgram::slots numbers; kept
  /// nodes are written to their slots in it.
  static std::unique_ptr<ValueCode> compile(const Recording& recording, const ValueTask& task,
                                            const ValueProgram& program, int slot_array);

  /// @param arrays the address of each array. @return false if a guard does not hold; the outputs
  /// are then invalid.
  virtual bool run(const Arrays& arrays) const = 0;
};

}  // namespace codesign
