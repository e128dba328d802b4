// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_EQUATIONS_EQUATION_CODE_H_
#define MECHANISM_CODESIGN_EQUATIONS_EQUATION_CODE_H_

#include <array>
#include <atomic>
#include <cstddef>
#include <memory>
#include <mutex>
#include <vector>

#include "codegen/straight_line.h"
#include "codegen/tangent_program.h"
#include "codegen/traced.h"
#include "codegen/value_code.h"
#include "equations/equation_function.h"
#include "sparse/sparsity.h"
#include "system/system.h"

namespace codesign {

/// The arrays that the code of the equations works on: the state, numbers that come with the design or the instant, results, and what only
/// the code itself reads.
struct EquationArrays {
  static constexpr int kQ = 0, kV = 1, kS = 2, kZ = 3, kNumbers = 4, kResults = 5, kSlots = 9, kRows = 10;
};

/// One function compiled for one scalar: values, and for Lanes their derivatives.
struct CompiledFunction {
  std::unique_ptr<ValueCode> values;
  std::unique_ptr<StraightLine> tangents;
  std::size_t slots = 0, rows = 0;  ///< numbers needed beside the results
};

/// A recording with a place for the number of each node that is not computed by the code itself.
struct NumberedRecording {
  Recording recording;
  std::array<std::unique_ptr<TangentProgram>, 3> tangents;  ///< of each EquationFunction, where derivatives were asked for
  std::vector<int> numbers;                                 ///< the nodes that array kNumbers holds, in its order
  std::vector<Place> homes;                                 ///< per node

  /// First entry of kNumbers of each function of time (-1 if its derivative of that order is not used), and of each position's turns.
  std::vector<std::array<int, Recording::kFunctionOrders>> functions;
  std::vector<std::array<int, 2>> turns;  ///< entry of State::turns, entry of kNumbers

  void number_nodes();
};

/// The equations of one mechanism and study, recorded once; their derivatives, and code for each scalar, are made when they are first asked
/// for. Immutable beside that, thread-safe, shared by all designs.
class EquationCode {
 public:
  /// For which scalar code is compiled.
  struct Scalar {
    int lanes;   ///< 0 for double
    bool split;  ///< derivatives alone, with the state's values and directions in arrays of their own
  };

  /// Records the equations.
  EquationCode(const System& system, const AssemblyPlan& plan);

  /// Whether they could be recorded.
  bool usable() const { return !values_.recording.refused(); }
  /// Null if there is no code. Of split scalars, kQ to kZ are values to the one part and directions to the other.
  const CompiledFunction* function(EquationFunction function, const Scalar& scalar) const;

  /// What the code of values, or of values and derivatives, was made from.
  const NumberedRecording& numbered(bool with_derivatives) const;
  /// Decisions that depend on the design alone.
  const std::vector<Recording::Guard>& design_guards() const { return design_guards_; }

 private:
  static constexpr std::size_t kFunctions = 3;

  struct Recorded {
    std::vector<ValueTask::Output> outputs;
    std::vector<Recording::Guard> guards;
  };
  void record(const System& system, const AssemblyPlan& plan);
  void take_guards(std::size_t first, Recorded* function);
  /// Notes what a function gave, and the guards from the first that is not noted yet on.
  void take(EquationFunction function, const std::vector<const VectorX<Traced>*>& results, std::size_t* guards);
  void differentiate() const;
  std::unique_ptr<CompiledFunction> compile(std::size_t function, const Scalar& scalar) const;
  ValueTask value_task(std::size_t function, const Scalar& scalar, std::vector<Place>* value_places) const;
  std::vector<Sum> tangent_sums(std::size_t function, const std::vector<Place>& value_places) const;

  NumberedRecording values_;
  std::array<Recorded, kFunctions> functions_;
  std::vector<Recording::Guard> design_guards_;

  mutable std::once_flag differentiated_;
  mutable NumberedRecording derivatives_;  ///< values_ and what derivatives take besides
  struct Known {
    std::atomic<bool> tried{false};
    std::unique_ptr<CompiledFunction> code;
  };
  mutable std::mutex mutex_;
  mutable std::array<std::array<Known, 5>, kFunctions> known_;  ///< for double, Lanes<4>, Lanes<8>, and these split
};

/// Records when first asked.
class LazyEquationCode {
 public:
  const EquationCode* get(const System& system, const AssemblyPlan& plan) {
    std::call_once(once_, [&] { code_ = std::make_unique<EquationCode>(system, plan); });
    return code_->usable() ? code_.get() : nullptr;
  }

 private:
  std::once_flag once_;
  std::unique_ptr<EquationCode> code_;
};

}  // namespace codesign

#endif  // MECHANISM_CODESIGN_EQUATIONS_EQUATION_CODE_H_
