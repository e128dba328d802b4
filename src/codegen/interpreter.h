// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_CODEGEN_INTERPRETER_H_
#define MECHANISM_CODESIGN_CODEGEN_INTERPRETER_H_

#include <memory>
#include <vector>

#include "codegen/straight_line.h"
#include "codegen/value_code.h"

namespace codesign {

/// A ValueProgram that a loop executes, one instruction after the other: for processors without machine code, for programs that are too
/// long for it, for a few evaluations, and for complex numbers. With doubles the results equal those of the machine code to the last bit.
class Interpreter final : public ValueCode {
 public:
  /// @param slot_array as of ValueCode::compile().
  Interpreter(const Recording& recording, const ValueTask& task, const ValueProgram& program, int slot_array);

  /// @tparam T double or std::complex<double>; complex products are rounded before they are added.
  /// @param arrays the address of each array, whose entries are of type T. The loop writes to its targets although they are declared const.
  /// @return Guard::decision of the guard that does not hold and was decided first; -1 if all hold. The outputs are valid only then.
  template <class T>
  int execute(const std::array<const T*, kCodeArrays>& arrays) const;

  bool run(const Arrays& arrays) const override { return execute<double>(arrays) < 0; }

 private:
  enum class Action : std::uint8_t { kOperate, kProductPlus, kProductMinus, kMinusProduct, kGuardLess, kGuardGreaterEqual };
  struct Step {
    Action action;
    Operation operation;
    Place a, b, c;
    std::vector<Place>::size_type first_target, last_target;  ///< among targets_
    int decision;                                             ///< of a guard
  };
  template <class T>
  static T value_of_step(const Step& step, const T& a, const T& b, const T& c);

  std::vector<Step> steps_;
  std::vector<Place> targets_;
};

/// A list of sums without start, scale and reciprocal that a loop computes, as StraightLine does to the last bit.
std::unique_ptr<StraightLine> interpret_sums(std::vector<Sum> sums, int width, const StraightLine::RowLayouts& layouts);

}  // namespace codesign

#endif  // MECHANISM_CODESIGN_CODEGEN_INTERPRETER_H_
