// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_EQUATIONS_EQUATIONS_H_
#define MECHANISM_CODESIGN_EQUATIONS_EQUATIONS_H_

#include <vector>

#include "equations/compiled_equations.h"
#include "equations/compiled_system.h"
#include "equations/formulas.h"

namespace codesign {

/// The equations of motion of one design, doc/theory.md (14): the formulas, and in their place the code that was compiled for this
/// mechanism wherever it can run. T: double, std::complex<double> or Lanes<N>. No allocation once warm; not thread-safe.
template <class T>
class Equations {
 public:
  /// @param system must outlive the equations.
  explicit Equations(const CompiledSystem& system) : system_(system), formulas_(system), compiled_(system) {}

  /// Evaluates all constants at `parameters` (all named parameters). Allocates.
  void set_design(const std::vector<T>& parameters) {
    compiled_.set_design(parameters);
    formulas_.set_design(parameters);
  }
  const std::vector<T>& parameters() const { return formulas_.view().design.parameters; }
  const Constants<T>& constants() const { return formulas_.view().design.constants; }
  const PairRows<T>& rows(int pair) const { return formulas_.view().design.rows[static_cast<std::size_t>(pair)]; }

  /// Residual G (Layout::columns() rows) and the objective's integrand g at a state.
  void residual(const State<T>& state, VectorX<T>* G, T* g) {
    if (!compiled_.residual(state, G, g)) formulas_.residual(state, G, g);
  }
  /// Derivatives of G and g, on CompiledSystem::patterns().
  void linearize(const State<T>& state, Linearization<T>* derivatives) {
    if (!compiled_.linearize(state, derivatives)) formulas_.linearize(state, system_.plan(), derivatives);
  }
  /// Constraint values Phi(q) (m rows) and rates Phi_q v of a state, whose z is not used.
  void constraint_errors(const State<T>& state, VectorX<T>* Phi, VectorX<T>* Phi_rate) {
    if (!compiled_.constraint_errors(state, Phi, Phi_rate)) formulas_.constraint_errors(state, Phi, Phi_rate);
  }

  /// Sets the turn references of a state to the present positions of its turning joints.
  void track_turns(State<T>* state) { formulas_.track_turns(state); }

  /// The formulas, for everything that is not compiled.
  Formulas<T>& formulas() { return formulas_; }
  const Formulas<T>& formulas() const { return formulas_; }
  /// The code that runs in their place.
  CompiledEquationsOf<T>& compiled() { return compiled_; }

 private:
  const CompiledSystem& system_;
  Formulas<T> formulas_;
  CompiledEquationsOf<T> compiled_;
};

}  // namespace codesign

#endif  // MECHANISM_CODESIGN_EQUATIONS_EQUATIONS_H_
