// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_EQUATIONS_FORMULAS_H_
#define MECHANISM_CODESIGN_EQUATIONS_FORMULAS_H_

#include <vector>

#include "elements/contact_friction.h"
#include "elements/friction_state.h"
#include "elements/power_kind.h"
#include "elements/state_view.h"
#include "elements/workspace.h"
#include "forces/spring_damper.h"

namespace codesign {

/// The formulas of the equations of motion, evaluated element by element; doc/theory.md (14):
///   rows 0..n:      M a + Phi_q^T lambda - Q - Q_Af = 0
///   rows n..n+m:    Phi_q a + (Phi_q v)_q v = 0
///   rows n+m..:     sigma - s' = 0, integrals of controllers, then states of friction laws
/// T: double, std::complex<double>, Lanes<N> or Traced; the same code gives values, derivatives and the recording that is compiled. No
/// allocation once warm; not thread-safe.
template <class T>
class Formulas {
 public:
  /// @param system must outlive the formulas.
  explicit Formulas(const System& system);

  /// Evaluates all constants at `parameters` (all named parameters). Allocates.
  void set_design(const std::vector<T>& parameters);
  StateView<T>& view() { return view_; }
  const StateView<T>& view() const { return view_; }

  /// Residual G (Layout::columns() rows) and the objective's integrand g at a state.
  void residual(const State<T>& state, VectorX<T>* G, T* g);
  /// Derivatives of G and g. @param plan of this system's assembly.
  void linearize(const State<T>& state, const AssemblyPlan& plan, Linearization<T>* derivatives);
  /// Assembles all derivatives at the loaded state through `sink->position(row, column, x)`, `velocity(...)`, `rate(...)` and
  /// `time(row, x)`. The order of the calls depends on the system only, never on the state.
  template <class Sink>
  void assemble(Sink* sink);
  /// Constraint values Phi(q) (m rows) and rates Phi_q v of a state, whose z is not used.
  void constraint_errors(const State<T>& state, VectorX<T>* Phi, VectorX<T>* Phi_rate);
  /// The same of one pair's rows, for bodies that move as given; the ground is a body at rest.
  void pair_errors(int pair, const BodyKinematics<T>& i, const BodyKinematics<T>& j, T* errors, T* rates) const;

  /// Sets the turn references of a state to the present positions of its turning joints.
  void track_turns(State<T>* state);

  /// Terminal objective terms w at a state, with their gradient if asked for.
  T terminal(const State<T>& state, SparseGradient<T>* gradient);
  /// Value of a signal at a state, with its gradient if asked for.
  T signal(const Signal& signal, const State<T>& state, SparseGradient<T>* gradient = nullptr);

  // The functions below are of the state that load() took last.
  void load(const State<T>& state);
  const BodyKinematics<T>& body(int index) const { return view_.body(index); }
  const CoordinateMotion<T>& coordinate(int pair, int element, CoordinateDetail detail = CoordinateDetail::kAll) const;
  FrictionState<T> friction(int pair, int element) const;
  /// Isotropic friction of a pair among System::contacts().
  ContactFriction<T> contact(int pair, CoordinateDetail detail = CoordinateDetail::kGradient) const;
  /// The k-th spring-damper of the description.
  SpringForce<T> spring(std::size_t k) const;
  /// What controllers apply along a coordinate [N or N m].
  T effort(int pair, int element) const;
  /// Mechanical energy [J], and the power [W] that goes into the mechanism, with their gradients if asked for; theory (14b), (14c).
  T kinetic_energy(SparseGradient<T>* gradient) const;
  T potential_energy(SparseGradient<T>* gradient) const;
  T power(PowerKind kind, SparseGradient<T>* gradient) const;
  /// Of one joint: a pair and its chain element.
  T joint_power(PowerKind kind, int pair, int element, SparseGradient<T>* gradient) const;
  T setpoint(int controller) const;
  T controller_output(int controller, SparseGradient<T>* gradient) const;
  T controller_error(int controller, SparseGradient<T>* gradient) const;
  /// Reaction force [N] and torque [N m] on the child in the parent's joint axes, as far as the pair constrains them.
  void reaction(int pair, Vector3<T>* F, Vector3<T>* torque) const;
  /// The share of the multipliers in a reaction signal; theory (11a).
  T multiplier_reaction(const SignalReference& term) const;

 private:
  StateView<T> view_;
  Workspace<T> workspace_;
};

}  // namespace codesign

#endif  // MECHANISM_CODESIGN_EQUATIONS_FORMULAS_H_
