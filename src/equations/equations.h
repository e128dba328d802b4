// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <type_traits>
#include <vector>

#include "control/control_clock.h"
#include "equations/compiled_equations.h"
#include "joints/pair_rows.h"

namespace codesign {

class CompiledSystem;
template <class T>
class Formulas;
template <class T>
struct Constants;

/// The equations of motion of one design, doc/theory.md (14), as integrators and sensitivities use
/// them: what was recorded of the formulas for this mechanism. T: double, std::complex<double> or
/// Lanes<N>. With double the formulas themselves serve observers (formulas()). Call set_design()
/// first. No allocation after the first evaluation; not thread-safe: one per thread, while the
/// CompiledSystem is shared.
template <class T>
class Equations {
 public:
  /// @param system must outlive the equations.
  explicit Equations(const CompiledSystem& system);
  Equations(Equations&&) noexcept;
  ~Equations();

  /// Evaluates all constants at `parameters` (all named parameters, order of Study::parameters).
  /// Allocates nothing but the first time.
  void set_design(const std::vector<T>& parameters);
  const std::vector<T>& parameters() const { return compiled_.parameters(); }
  /// The constants and constraint rows of the present design; for double only.
  const Constants<T>& constants() const;
  const PairRows<T>& rows(int pair) const;

  /// The residual G (resized to Layout::columns()) and the objective's integrand g, theory (14),
  /// (21), at a state.
  void residual(const State<T>& state, VectorX<T>* G, T* g) { compiled_.residual(state, G, g); }
  /// The derivatives of G and g at a state. @param derivatives of the size of
  /// CompiledSystem::patterns(); overwritten.
  void linearize(const State<T>& state, Linearization<T>* derivatives) {
    compiled_.linearize(state, derivatives);
  }
  /// The residual with the part G_z of its derivatives alone, as a solve for z = (a, lambda, sigma)
  /// needs them.
  void rates(const State<T>& state, VectorX<T>* G, T* g, Linearization<T>* derivatives) {
    compiled_.rates(state, G, g, derivatives);
  }
  /// Sets z to the solution of G = 0, g, and the factors of G_z, where one expression gives them.
  /// @return false elsewhere; then z stays.
  bool accelerations(State<T>* state, T* g, std::vector<T>* factors) {
    return compiled_.accelerations(state, g, factors);
  }
  /// The pattern of those factors at states like the last one; null elsewhere.
  const MassFactor* mass_factor() { return compiled_.mass_factor(); }
  /// G_z in `derivatives`, for solves without the other parts; they are overwritten too unless the
  /// linearization is recorded apart.
  void linearize_rates(const State<T>& state, Linearization<T>* derivatives);
  /// Constraint values Phi(q) and rates Phi_q v, both resized to Layout::m. The state's z is not
  /// used.
  void constraint_errors(const State<T>& state, VectorX<T>* Phi, VectorX<T>* Phi_rate) {
    compiled_.constraint_errors(state, Phi, Phi_rate);
  }

  /// The sum w of the terminal terms of the objective, theory (21), and its gradient. @param
  /// gradient overwritten, here and below.
  T terminal(const State<T>& state);
  T terminal_gradient(const State<T>& state, SparseGradient<T>* gradient) {
    return signals_.signal(EquationFunction::kTerminal, state, gradient);
  }
  /// Signal minus reference of the k-th watched signal, theory (21a), in SI units, and its
  /// gradient.
  T watched(std::size_t k, const State<T>& state);
  T watched_gradient(std::size_t k, const State<T>& state, SparseGradient<T>* gradient) {
    return signals_.signal(watched_function(k), state, gradient);
  }
  /// Formulas::residuals().
  void residuals(ObjectivePart part, const State<T>& state, VectorX<T>* residuals);

  /// Sets q and v, of the sizes of the layout, to those of tree coordinates theta (TreeLayout) and
  /// their rates.
  void place(const VectorX<T>& theta, const VectorX<T>& theta_rate, State<T>* state) {
    start_.place(theta, theta_rate, state);
  }
  /// Sets State::turns to the joint positions of the state; integrators call it after each step.
  void track_turns(State<T>* state);
  /// stuck_slips() at a state. @param accelerations, limits of their sizes, overwritten.
  void stuck_slips(const State<T>& state, VectorX<T>* accelerations, VectorX<T>* limits);
  /// Sets the states that do not begin at zero, at the positions and velocities of a state: of
  /// friction laws to steady sliding, theory (13j), of controllers to their values at t = 0, theory
  /// (50), (51), filters at rest and first samples taken. Other states stay.
  void begin_states(State<T>* state);
  /// Carries the states of sampled controllers over the events of an instant, theory (51). The
  /// rates state->z do not change; solve for them afterwards.
  void jump(const std::vector<ControlEvent>& events, State<T>* state);

  /// CompiledEquations::hold() and release(), for the steps of a run. An empty mode: release().
  void hold(const std::vector<bool>& mode) {
    mode.empty() ? compiled_.release() : compiled_.hold(mode);
  }
  /// The formulas, for what observers read: signals, energies, friction, reactions; for double
  /// only.
  Formulas<T>& formulas() { return *formulas_; }
  const Formulas<T>& formulas() const { return *formulas_; }
  /// The recorded equations, for instance to do without machine code.
  CompiledEquations<T>& compiled() { return compiled_; }

 private:
  void begin_bristles(State<T>* state);
  void begin_controllers(State<T>* state);
  static constexpr bool kIsReal = std::is_same_v<T, double>;

  T sample(int controller, bool is_first, State<T>* state);

  const CompiledSystem& system_;
  std::unique_ptr<Formulas<T>> formulas_;  ///< for double only
  CompiledEquations<T> compiled_, signals_, start_;
  VectorX<T> residual_;  ///< workspace of linearize_rates()
};

template <>
const Constants<double>& Equations<double>::constants() const;
template <>
const PairRows<double>& Equations<double>::rows(int pair) const;

}  // namespace codesign
