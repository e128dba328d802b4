// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <cstddef>
#include <memory>
#include <utility>
#include <vector>

#include "codegen/recording.h"
#include "codegen/straight_line.h"
#include "codegen/value_code.h"
#include "math/scalar.h"

namespace codesign {

/// The result of one operation of a Recording. @param b ignored by operations with one operand. For
/// kLeaf and kLiteral, which do not compute anything, the result is a.
template <class T>
T operate(Operation operation, const T& a, const T& b) {
  using std::asin, std::cos, std::exp, std::log, std::sin, std::sqrt, std::tanh;
  switch (operation) {
    case Operation::kAdd:
      return a + b;
    case Operation::kSubtract:
      return a - b;
    case Operation::kMultiply:
      return a * b;
    case Operation::kDivide:
      return a / b;
    case Operation::kNegate:
      return -a;
    case Operation::kSquareRoot:
      return sqrt(a);
    case Operation::kRound:
      return T(std::nearbyint(value_of(a)));
    case Operation::kTanh:
      return tanh(a);
    case Operation::kExp:
      return exp(a);
    case Operation::kLog:
      return log(a);
    case Operation::kSin:
      return sin(a);
    case Operation::kCos:
      return cos(a);
    case Operation::kArcSine:
      return asin(a);
    case Operation::kArcTangent:
      return arc_tangent(a, b);
    case Operation::kLeaf:
    case Operation::kLiteral:
      break;
  }
  return a;
}

/// A ValueProgram that loops execute, each over instructions of one kind that follow from those
/// before: for processors without machine code, for programs that are too long for it, for a few
/// evaluations, and for complex numbers. With doubles the results equal those of the machine code
/// to the last bit.
class Interpreter final : public ValueCode {
 public:
  /// @param slot_array as of ValueCode::compile().
  Interpreter(const Recording& recording, const ValueTask& task, const ValueProgram& program,
              int slot_array);

  /// @tparam T double or std::complex<double>; complex products are rounded before they are added.
  /// @param arrays the address of each array, whose entries are of type T. The loop writes to its
  /// targets although they are declared const.
  /// @return Guard::decision of the guard that does not hold and was decided first; -1 if all hold.
  /// The outputs are valid only then.
  template <class T>
  int execute(const std::array<const T*, kCodeArrays>& arrays) const;

  bool run(const Arrays& arrays) const override { return execute<double>(arrays) < 0; }

 private:
  struct Step {
    Place a, b, c;  ///< operands; an absent one is that before it
    Place target;   ///< of a guard: no array, and Guard::decision as the index
  };
  /// Steps of one kind, in turn.
  struct Batch {
    ValueProgram::Kind kind;
    Operation operation;
    std::size_t first, last;
  };
  /// Puts instructions of one kind side by side. @param steps one or more per instruction, in the
  /// order of the program. @param slots the number of entries of array `slot_array`, the only one
  /// of which steps read what other steps wrote.
  void arrange(const std::vector<std::pair<Batch, Step>>& steps, int slot_array, int slots);
  template <class T, class Value>
  void compute(const Batch& batch, const std::array<const T*, kCodeArrays>& arrays,
               const Value& value) const;
  template <class T>
  void compute(const Batch& batch, const std::array<const T*, kCodeArrays>& arrays) const;

  std::vector<Step> steps_;
  std::vector<Batch> batches_;
};

/// A list of sums without start, scale and reciprocal that a loop computes, as StraightLine does to
/// the last bit.
std::unique_ptr<StraightLine> interpret_sums(std::vector<Sum> sums, int width,
                                             const StraightLine::RowLayouts& layouts);

}  // namespace codesign
