// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_CODEGEN_VALUE_CODE_H_
#define MECHANISM_CODESIGN_CODEGEN_VALUE_CODE_H_

#include <array>
#include <memory>

#include "codegen/value_program.h"

namespace codesign {

/// A ValueProgram compiled into machine code without loops; of several values, that which is needed again last leaves its register
/// (Belady's rule).
class ValueCode {
 public:
  using Arrays = std::array<const double*, kCodeArrays>;

  virtual ~ValueCode() = default;

  /// Whether anything can be compiled here.
  static bool is_available();

  /// @param slot_array where intermediate values may be left, ValueProgram::slots of them, the kept ones at their slots.
  /// Null where code cannot be run (StraightLine::compile()), or would be longer than some megabytes by a generous estimate.
  static std::unique_ptr<ValueCode> compile(const Recording& recording, const ValueTask& task, const ValueProgram& program, int slot_array);

  /// False where a guard does not hold; outputs are then worth nothing.
  virtual bool run(const Arrays& arrays) const = 0;
};

}  // namespace codesign

#endif  // MECHANISM_CODESIGN_CODEGEN_VALUE_CODE_H_
