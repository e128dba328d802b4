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
#include "sparse/sparsity.h"
#include "system/state.h"

namespace codesign {

class EquationCode;
struct CompiledFunction;
struct NumberedRecording;

/// The equations of one design run as code that was compiled for their mechanism; the same numbers as Equations gives, but for rounding.
/// T: double or Lanes<N>. No allocation once warm; not thread-safe.
template <class T>
class CompiledEquations {
 public:
  explicit CompiledEquations(const CompiledSystem& system) : system_(system) {}

  void set_design(const std::vector<T>& parameters);
  /// False: leaves everything to Equations.
  void allow(bool allowed) { allowed_ = allowed; }

  // As the functions of Equations. False where there is no code, or the state asks for a branch that was not recorded: then nothing is
  // said about the results.
  bool residual(const State<T>& state, VectorX<T>* G, T* g);
  bool linearize(const State<T>& state, Linearization<T>* derivatives);
  bool constraint_errors(const State<T>& state, VectorX<T>* Phi, VectorX<T>* Phi_rate);

  /// Derivatives alone, N side by side for each number, where values and directions stand in arrays of their own; only of Lanes<N>.
  /// @param values, directions of q, v, s and z, @param results as EquationFunction lists them.
  bool tangents(EquationFunction function, double t, const std::vector<double>& turns, const double* const (&values)[4],
                const double* const (&directions)[4], double* const (&results)[4]);

 private:
  bool prepare();
  /// Evaluates what depends on the design alone; false if a branch was not recorded for it.
  bool fill_numbers();
  void set_instant(double t, const std::vector<double>& turns);

  /// Evaluations of a function whose branch was not recorded. After some in a row the code is not tried for a while.
  struct Misses {
    int in_a_row = 0, pause = 0;
  };
  bool is_worth_trying(EquationFunction function);
  bool note(EquationFunction function, bool recorded);

  /// The code of a function, made ready for an instant; null if there is none, or it had better not be tried.
  const CompiledFunction* begin(EquationFunction function, bool split, double t, const std::vector<double>& turns);
  bool run(EquationFunction function, double t, const std::vector<double>& turns, const T* const (&state)[4], T* const (&results)[4]);

  const CompiledSystem& system_;
  std::vector<T> parameters_;
  bool allowed_ = true;
  bool known_ = false;  ///< whether code_ and numbers_ are those of parameters_
  const EquationCode* code_ = nullptr;
  const NumberedRecording* numbered_ = nullptr;
  std::vector<T> numbers_;
  std::vector<std::variant<Reference<T>, ShapedInput<T>>> functions_;  ///< of time
  std::array<Misses, 3> misses_;
  LineVector slots_, rows_;
};

/// For scalars that are only computed with to check others, or to record.
template <class T>
class NoCompiledEquations {
 public:
  explicit NoCompiledEquations(const CompiledSystem&) {}
  void set_design(const std::vector<T>&) {}
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

template <class T>
using CompiledEquationsOf =
    std::conditional_t<std::is_same_v<T, std::complex<double>> || std::is_same_v<T, Traced>, NoCompiledEquations<T>, CompiledEquations<T>>;

}  // namespace codesign

#endif  // MECHANISM_CODESIGN_EQUATIONS_COMPILED_EQUATIONS_H_
