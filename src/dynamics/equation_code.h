// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_SRC_DYNAMICS_EQUATION_CODE_H_
#define MECHANISM_CODESIGN_SRC_DYNAMICS_EQUATION_CODE_H_

#include <array>
#include <atomic>
#include <cstddef>
#include <memory>
#include <mutex>
#include <vector>

#include "math/straight_line.h"
#include "math/tangent_program.h"
#include "math/value_code.h"
#include "mechanism_codesign/dynamics/compiled_equations.h"

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

/// The equations of one mechanism and study, recorded once and compiled for each scalar when that is first asked for. Immutable beside
/// that, thread-safe, shared by all designs.
class EquationCode {
 public:
  static constexpr std::size_t kFunctions = 3;

  /// For which scalar code is compiled.
  struct Scalar {
    int lanes;   ///< 0 for double
    bool split;  ///< derivatives alone, with the state's values and directions in arrays of their own
  };

  /// Records the equations.
  explicit EquationCode(const System& system);

  /// Whether they could be recorded.
  bool usable() const { return !recording_.refused(); }
  /// Null if there is no code. Of split scalars, kQ to kZ are values to the one part and directions to the other.
  const CompiledFunction* function(EquationFunction function, const Scalar& scalar) const;

  const Recording& recording() const { return recording_; }
  /// The nodes that array kNumbers holds, in its order.
  const std::vector<int>& numbers() const { return numbers_; }
  /// Decisions that depend on the design alone.
  const std::vector<Recording::Guard>& design_guards() const { return design_guards_; }
  /// First entry of kNumbers of each function of time (-1 if its derivative of that order is not used), and of each position's turns.
  struct Instant {
    std::vector<std::array<int, Recording::kFunctionOrders>> functions;
    std::vector<std::array<int, 3>> turns;  ///< pair, element, entry
  };
  const Instant& instant() const { return instant_; }

 private:
  struct Recorded {
    std::vector<ValueTask::Output> outputs;
    std::vector<Recording::Guard> guards;
    std::unique_ptr<TangentProgram> tangent;
  };
  void record(const System& system);
  void take_guards(std::size_t first, Recorded* function);
  /// Notes what a function gave, and the guards from the first that is not noted yet on.
  void take(EquationFunction function, const std::vector<const VectorX<Traced>*>& results, std::size_t* guards);
  void differentiate();
  void number_nodes();
  bool is_number(int node) const;
  std::unique_ptr<CompiledFunction> compile(const Recorded& recorded, const Scalar& scalar) const;
  ValueTask value_task(const Recorded& recorded, const Scalar& scalar, std::vector<Place>* value_places) const;

  Recording recording_;
  std::array<Recorded, kFunctions> functions_;
  std::vector<Recording::Guard> design_guards_;
  std::vector<int> numbers_;
  std::vector<std::array<int, 2>> turn_owners_;  ///< pair and element of each leaf that counts turns
  std::vector<Place> homes_;                     ///< per node
  Instant instant_;

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
  const EquationCode* get(const System& system) {
    std::call_once(once_, [&] { code_ = std::make_unique<EquationCode>(system); });
    return code_->usable() ? code_.get() : nullptr;
  }

 private:
  std::once_flag once_;
  std::unique_ptr<EquationCode> code_;
};

}  // namespace codesign

#endif  // MECHANISM_CODESIGN_SRC_DYNAMICS_EQUATION_CODE_H_
