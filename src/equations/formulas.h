// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "elements/contact.h"
#include "elements/energy.h"
#include "elements/state_view.h"
#include "equations/equation_function.h"
#include "math/arrays.h"

namespace codesign {

/// The equations of motion G(q, v, s, t; z) = 0 of one mechanism and study, evaluated element by
/// element; doc/theory.md (14):
///   rows 0 to n-1:    M a + Phi_q^T lambda - Q - Q_Af  [N on r, N m on p]
///   rows n to n+m-1:  Phi_q a + (Phi_q v)_q v; with redundant constraints the rows of theory (23),
///                     then those of (23b)
///   rows n+m to end:  sigma - s': integrals of controllers, then states of friction laws
/// Layout gives the place of each row and of each unknown of z = (a, lambda, sigma).
///
/// T is the scalar: Traced to record the operations, from which everything that integrators and
/// sensitivities evaluate is made (Equations), or double for observers. Call set_design() first. No
/// allocation after the first evaluation; not thread-safe.
template <class T>
class Formulas {
 public:
  /// @param system must outlive the formulas.
  explicit Formulas(const System& system);

  /// Evaluates all constants at `parameters` (all named parameters, order of Study::parameters).
  /// Allocates nothing but the first time.
  void set_design(const std::vector<T>& parameters);
  /// The data that the elements read.
  const StateView<T>& view() const { return view_; }

  /// The residual G (Layout::columns() rows) and the objective's integrand g, theory (21), at a
  /// state.
  void residual(const State<T>& state, VectorX<T>* G, T* g);
  /// Constraint values Phi(q) and rates Phi_q v, Layout::m entries each; entries from
  /// Layout::constraints() on are zero. The state's z is not used, but must have its size.
  void constraint_errors(const State<T>& state, VectorX<T>* Phi, VectorX<T>* Phi_rate);
  /// Phi and Phi_q v of one pair's rows, for bodies that move as given; the ground is a body at
  /// rest.
  /// @param errors, rates one value per row of the pair.
  void pair_errors(int pair, const BodyKinematics<T>& i, const BodyKinematics<T>& j, Out<T> errors,
                   Out<T> rates) const;

  /// The output of a sampled controller at a sample of the loaded state, theory (51); its memory in
  /// `s` is updated.
  T sample(int controller, bool is_first, VectorX<T>* s) const;

  /// Sets State::turns to the joint positions of the state. To be called after each step, so that
  /// positions count whole turns.
  void track_turns(State<T>* state);

  /// The sum w of the terminal terms of the objective, theory (21).
  T terminal(const State<T>& state);
  /// sqrt(weight) loss_root() of each term of the integrand g or of the terminal terms w, whose
  /// squares are the terms, theory (22a). Zero for a weight that is not positive, where the root
  /// has no derivative, and for a loss that is no square.
  void residuals(ObjectivePart part, const State<T>& state, VectorX<T>* residuals);
  /// Signal minus reference of the k-th watched signal, theory (21a), in SI units.
  T watched(std::size_t k, const State<T>& state);
  /// The condition of Study::until at a state: 1 where it holds, else 0; 0 without one.
  T until(const State<T>& state);
  /// Evaluates the expressions of signals that are watched along a run and have switches, so that a
  /// recording knows these.
  void watch_switches(const State<T>& state);
  /// The value of a signal at a state, in SI units.
  T signal(const Signal& signal, const State<T>& state);

  /// Loads the state that the functions below read. @param state must stay alive and unchanged
  /// while they are called.
  void load(const State<T>& state);
  /// The value of a signal, in SI units.
  T signal(const Signal& signal) const;
  /// The motion of a body; -1 is the ground.
  const BodyKinematics<T>& body(int index) const { return view_.body(index); }
  /// The motion of a joint coordinate, theory (8). @param element index in the pair's chain.
  const CoordinateMotion<T>& coordinate(int pair, int element,
                                        CoordinateDetail detail = CoordinateDetail::kAll) const;
  /// The friction of a joint coordinate, theory (13); zero if it has none.
  FrictionState<T> friction(int pair, int element) const;
  /// Isotropic friction of a pair among System::contacts(), theory (13a).
  ContactFriction<T> contact(int pair) const;
  /// stuck_slips() of the loaded state.
  void stuck_slips(VectorX<T>* accelerations, VectorX<T>* limits) const;
  /// begin_bristles() at the loaded state. @param s all extra states.
  void begin_bristles(VectorX<T>* s) const;
  /// The effort that controllers apply along a coordinate, within the actuator's limit (13c) [N or
  /// N m].
  T effort(int pair, int element) const;
  /// The current at which that of a winding stays, theory (9d) [A].
  T steady_current(const Winding& winding) const;
  /// Mechanical energy T and V [J]; theory (14b).
  T kinetic_energy() const;
  T potential_energy() const;
  /// The power of one kind that goes into the mechanism [W]; theory (14c).
  T power(PowerKind kind) const;
  /// Setpoint r, output u [N or N m] before the actuator's limit, and error e = r - x of a
  /// controller; theory (C1)-(C8).
  T setpoint(int controller) const;
  T controller_output(int controller) const;
  T controller_error(int controller) const;
  /// Reaction force F'' [N] and torque T'' [N m] in the joint axes of body i, theory (11); the
  /// child feels -F'' and -T''. Components that the pair does not constrain are zero.
  void reaction(int pair, Vector3<T>* F, Vector3<T>* torque) const;
  /// The normal force N [N] in the bearing of a pair, theory (12); its joint must have a
  /// BearingLaw.
  T normal_force(int pair) const;
  /// The part of a reaction signal, theory (11a), that comes from multipliers: constraint rows and
  /// couplings.
  T multiplier_reaction(const SignalReference& term) const;

 private:
  StateView<T> view_;
};

}  // namespace codesign
