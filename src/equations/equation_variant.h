// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <memory>
#include <mutex>
#include <vector>

#include "codegen/derivatives.h"
#include "codegen/interpreter.h"
#include "codegen/straight_line.h"
#include "codegen/traced.h"
#include "codegen/value_code.h"
#include "equations/compiled_system.h"
#include "equations/equation_function.h"
#include "equations/mass_solution.h"
#include "math/arrays.h"

namespace codesign {

struct EquationRecorder;
struct ResidualRecording;
class TransposedCode;

/// The arrays that the compiled code reads and writes, by index: the state q, v, s, z; numbers that
/// depend on design, time and turn references; up to four results (see EquationFunction); and two
/// workspaces of the code.
struct EquationArrays {
  static constexpr int kQ = 0, kV = 1, kS = 2, kZ = 3, kNumbers = 4, kResults = 5, kSlots = 9,
                       kRows = 10;
  /// Results of TransposedCode, whose results take the place of weights.
  static constexpr int kAdjoints = kRows;
};

/// One function for one scalar: code for the values and, for Lanes, code for the derivatives, which
/// runs after it.
struct CompiledFunction {
  std::unique_ptr<ValueCode> values;
  std::unique_ptr<StraightLine> tangents;
  const Interpreter* interpreter = nullptr;  ///< `values` if they are interpreted
  std::size_t slots = 0, rows = 0;           ///< sizes of the workspaces kSlots and kRows [doubles]
};

/// The code for the values of a task, with interpreter if `interpreted` or where machine code
/// cannot be made.
std::unique_ptr<CompiledFunction> compile_values(const Recording& recording, const ValueTask& task,
                                                 const ValueProgram& program, bool interpreted);

/// The results of one recorded function, and the decisions that they depend on.
struct RecordedFunction {
  std::vector<ValueTask::Output> outputs;
  std::vector<Recording::Guard> guards;
  std::vector<int> columns;     ///< of the gradient of a signal
  bool has_derivatives = true;  ///< whether tangents may be asked for
  bool has_products = false;    ///< whether transposed products may be
};

/// The guards that code checks: with `held` all but those of switches.
std::vector<Recording::Guard> checked(std::vector<Recording::Guard> guards, bool held);

/// A recording, and the array and index of each of its nodes that the code reads as an input:
/// entries of the state, and numbers that depend on the design, the time or a turn reference only.
struct NumberedRecording {
  Recording recording;
  /// per EquationFunction; empty without derivatives
  std::vector<std::unique_ptr<TangentProgram>> tangents;
  std::vector<int> numbers;  ///< the nodes of array kNumbers, in its order
  std::vector<Place> homes;  ///< per node: its array and index; array -1 if the code computes it

  /// Per function of time, the entry of kNumbers of its value and of each of its derivatives; -1 if
  /// it is not used.
  std::vector<std::array<int, Recording::kFunctionOrders>> functions;
  /// per turn reference that is used: entry of State::turns, entry of kNumbers
  std::vector<std::array<int, 2>> turns;

  /// Fills the members above from `recording`.
  void number_nodes();
};

/// One variant of the equations of one mechanism and study, shared by all designs: the formulas,
/// recorded with given outcomes of their decisions. The constructor records one part of them with
/// the scalar Traced, and derives the linearization from the recorded residual and the gradients of
/// signals from their recorded values; the tangents of the recording, and the code for each scalar,
/// are made when they are first needed. Thread-safe.
class EquationVariant {
 public:
  /// The scalar that a function is wanted for.
  struct Scalar {
    int lanes;  ///< 0 for double and for complex numbers, which are always interpreted
    /// only derivatives are computed, from values and directions of the state in separate arrays
    bool separate;
    bool interpreted;   ///< without machine code
    bool held = false;  ///< without the guards of switches, whose outcomes the caller holds
  };

  /// Records the equations. @param system must outlive this. @param outcomes of the first
  /// decisions; the later ones have their expected outcomes. @param mode of the first switches,
  /// which counts before `outcomes`. @param begun the residual with these
  /// outcomes, if it was recorded already; for the parts that begin with it.
  /// @throws std::logic_error if the formulas decide something without is_less().
  explicit EquationVariant(const CompiledSystem& system, EquationPart part,
                           std::vector<bool> outcomes = {}, std::vector<bool> mode = {},
                           std::unique_ptr<ResidualRecording> begun = nullptr);
  ~EquationVariant();

  /// One function, made by the first call. It is interpreted also where machine code cannot be
  /// made: on other processors than x86-64 and for very long programs. With separate directions the
  /// arrays kQ to kZ hold the state's values while CompiledFunction::values runs, and the
  /// directions while `tangents` runs.
  const CompiledFunction& function(EquationFunction function, const Scalar& scalar) const;

  /// The columns of a signal's gradient, its second result: (q, s), v, z and t side by side.
  const std::vector<int>& gradient_columns(EquationFunction function) const {
    return at(function).columns;
  }

  /// The recording from which the code for values, or for values and derivatives, is made.
  const NumberedRecording& numbered(bool with_derivatives) const;
  /// The transposed derivatives of the first functions of EquationPart::kMotion, up to kSwitches,
  /// or of the samples of EquationPart::kStart; made by the first call.
  const TransposedCode& transposed() const;
  /// The recorded decisions that depend on the design alone; the code may run only for designs with
  /// the same outcomes.
  const std::vector<Recording::Guard>& design_guards() const { return design_guards_; }
  /// Whether kAccelerations is there: for the explicit pair, in joint coordinates without loops, if
  /// G is affine in z, g free of it, and G_z a mass matrix.
  bool has_accelerations() const { return !mass_factor_.starts.empty(); }
  /// Of kAccelerations' third result.
  const MassFactor& mass_factor() const { return mass_factor_; }
  /// The outcomes of all decisions in turn, of which a variant is known.
  const std::vector<bool>& outcomes() const { return outcomes_; }
  /// Number of values of kExpressions; 1 without expressions of signals.
  std::size_t expressions() const { return at(EquationFunction::kExpressions).outputs.size(); }
  /// The outcomes of the residual's switches in turn, of which a run holds one set in each step;
  /// the same sequence in every part that begins with the residual, empty in the others.
  const std::vector<bool>& mode() const { return mode_; }
  /// Whether the condition of Study::until holds in this mode.
  bool ends_run() const { return ends_run_; }
  /// Where each of these switches was recorded.
  const std::vector<SwitchOrigin>& switch_origins() const {
    return values_.recording.switch_origins();
  }

 private:
  RecordedFunction& at(EquationFunction function) { return functions_[to_index(function)]; }
  const RecordedFunction& at(EquationFunction function) const {
    return functions_[to_index(function)];
  }
  void record_motion(EquationPart part, ResidualRecording* begun);
  void record_signals(EquationRecorder* equations);
  void record_start(EquationRecorder* equations);
  /// Records one function whose results `compute` returns.
  template <class Compute>
  void record(EquationFunction function, const Compute& compute);
  /// Records the differences of which the switches are the signs, and the expressions.
  void record_turns(EquationRecorder* equations);
  void record_switches(const Traced& g);
  /// Gives the decisions `first` to `last` - 1 of Recording::decisions() to a function if they vary
  /// with the state, else to design_guards_.
  void take_guards(std::size_t first, std::size_t last, std::vector<Recording::Guard>* guards);
  /// The same with the decisions before index `last`, which a design makes.
  void take_design_guards(std::size_t last);
  void record_accelerations(const std::vector<Traced>& G_z, EquationRecorder* equations);
  void take_outputs(EquationFunction function, const std::vector<VectorX<Traced>>& results);
  /// Makes derivatives_ from values_.
  void differentiate() const;
  std::unique_ptr<CompiledFunction> compile(std::size_t function, const Scalar& scalar) const;
  ValueTask value_task(std::size_t function, const Scalar& scalar,
                       std::vector<Place>* value_places) const;
  std::vector<Sum> tangent_sums(std::size_t function, const std::vector<Place>& value_places) const;

  const CompiledSystem& system_;
  bool long_ = false;  ///< too long for machine code
  NumberedRecording values_;
  Recording* recording_ = &values_.recording;  ///< while the constructor records
  /// per EquationFunction; empty for those of the other part
  std::vector<RecordedFunction> functions_;
  std::vector<Recording::Guard> design_guards_;
  std::vector<bool> outcomes_, mode_;
  bool ends_run_ = false;
  MassFactor mass_factor_;

  mutable std::once_flag differentiated_;
  /// the nodes of values_, then the nodes that derivatives need
  mutable NumberedRecording derivatives_;
  mutable std::once_flag transposed_once_;
  mutable std::unique_ptr<TransposedCode> transposed_;
  struct Known {
    std::atomic<bool> made{false};
    std::unique_ptr<CompiledFunction> code;
  };
  mutable std::mutex mutex_;
  /// Per function: double, Lanes<4>, Lanes<8>, the two with separate directions; then the same
  /// without machine code; then all of them without the guards of switches.
  mutable std::vector<std::array<Known, 20>> known_;
};

}  // namespace codesign
