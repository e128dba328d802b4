// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_EQUATIONS_COMPILED_EQUATIONS_H_
#define MECHANISM_CODESIGN_EQUATIONS_COMPILED_EQUATIONS_H_

#include <array>
#include <complex>
#include <type_traits>
#include <variant>
#include <vector>

#include "codegen/traced.h"
#include "control/reference.h"
#include "control/shaped_input.h"
#include "equations/compiled_system.h"
#include "equations/equation_function.h"
#include "math/line_vector.h"
#include "math/span.h"
#include "sparse/sparsity.h"
#include "system/state.h"

namespace codesign {

class EquationCode;
struct CompiledFunction;
struct NumberedRecording;

/// The equations of one design, evaluated by machine code that was compiled for their mechanism (EquationCode). The results equal the
/// results of Formulas within rounding. T: double or Lanes<N>. No allocation after the first evaluation; not thread-safe.
///
/// The recording holds one branch of each decision. Every evaluation compares its decisions with the recorded ones and fails if one
/// differs; Equations then evaluates the formulas.
template <class T>
class CompiledEquations {
 public:
  explicit CompiledEquations(const CompiledSystem& system) : system_(system) {}

  /// Takes the values of all named parameters; the constants are evaluated when a function is first called.
  void set_design(const std::vector<T>& parameters);
  /// With false every function returns false at once, so that the formulas are used.
  void allow(bool allowed) { allowed_ = allowed; }
  /// Forgets which evaluations failed before, so that the last bits of later results do not depend on them.
  void forget() { misses_ = {}; }

  /// The functions of Equations of the same name. False if there is no code, or if the state needs a branch that was not recorded; the
  /// results are then undefined.
  bool residual(const State<T>& state, VectorX<T>* G, T* g);
  bool linearize(const State<T>& state, Linearization<T>* derivatives);
  bool constraint_errors(const State<T>& state, VectorX<T>* Phi, VectorX<T>* Phi_rate);

  /// The derivatives of one function along N directions of state and design, for T = Lanes<N> only; false as above, and for T = double. The
  /// directions of the design are the directions of the parameters given to set_design().
  /// @param turns State::turns. @param values of q, v, s and z. @param directions of the same vectors, N numbers side by side per entry.
  /// @param results one array per result in the order of EquationFunction, N numbers side by side per entry; then empty arrays.
  bool tangents(EquationFunction function, double t, const std::vector<double>& turns, const In<double> (&values)[4],
                const In<double> (&directions)[4], const Out<double> (&results)[4]);

 private:
  /// Fetches the code and evaluates the constants of a new design. False if the code cannot be used for it.
  bool prepare();
  /// Evaluates the recorded numbers that depend on the design alone; false if the design needs a branch that was not recorded.
  bool fill_numbers();
  /// Evaluates the functions of time for the design.
  void set_functions();
  /// Evaluates the functions of time at `t` and copies the turn references to the code's inputs.
  void set_instant(double t, const std::vector<double>& turns);

  /// Counts the evaluations of a function that failed because the state needed a branch that was not recorded. After a few failures in a
  /// row the code is not tried for a while, since a failed evaluation costs time.
  struct Misses {
    int in_a_row = 0, pause = 0;
  };
  /// Whether the pause after failures is over; counts it down.
  bool is_worth_trying(EquationFunction function);
  /// Counts the outcome of an evaluation and returns it.
  bool note(EquationFunction function, bool recorded);

  /// The code of a function with its inputs set for an instant; null if there is none or the pause is not over.
  const CompiledFunction* begin(EquationFunction function, bool split, double t, const std::vector<double>& turns);
  bool run(EquationFunction function, double t, const std::vector<double>& turns, const In<T> (&state)[4], const Out<T> (&results)[4]);

  const CompiledSystem& system_;
  std::vector<T> parameters_;
  bool allowed_ = true;
  bool known_ = false;  ///< whether code_ and numbers_ belong to parameters_
  const EquationCode* code_ = nullptr;
  const NumberedRecording* numbered_ = nullptr;
  std::vector<T> nodes_;                                               ///< workspace of fill_numbers(): values of the recording's nodes
  std::vector<T> numbers_;                                             ///< array EquationArrays::kNumbers
  std::vector<std::variant<Reference<T>, ShapedInput<T>>> functions_;  ///< functions of time, order of the recording
  std::array<Misses, kEquationFunctions> misses_;                      ///< per EquationFunction
  LineVector slots_, rows_;                                            ///< workspace of the code
};

/// The interface of CompiledEquations for scalars without code: complex numbers, which serve checks, and Traced, which records. Every
/// function returns false.
template <class T>
class NoCompiledEquations {
 public:
  explicit NoCompiledEquations(const CompiledSystem&) {}
  void set_design(const std::vector<T>&) {}
  void forget() {}
  template <class... Arguments>
  bool residual(const Arguments&...) {
    return false;
  }
  template <class... Arguments>
  bool linearize(const Arguments&...) {
    return false;
  }
  template <class... Arguments>
  bool constraint_errors(const Arguments&...) {
    return false;
  }
};

/// CompiledEquations where T has code, else NoCompiledEquations.
template <class T>
using CompiledEquationsOf =
    std::conditional_t<std::is_same_v<T, std::complex<double>> || std::is_same_v<T, Traced>, NoCompiledEquations<T>, CompiledEquations<T>>;

}  // namespace codesign

#endif  // MECHANISM_CODESIGN_EQUATIONS_COMPILED_EQUATIONS_H_
