// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "elements/controllers.h"
#include "elements/forest.h"
#include "elements/sampled_control.h"
#include "elements/sharing.h"
#include "elements/signals.h"
#include "equations/formulas.h"
#include "math/arrays.h"

namespace codesign {

// The loop over the elements; elements/forest.h lists those that load bodies. Pairs, spring-dampers
// and constant loads on links come before the bodies, because they add to the loads that the bodies
// turn into rows; loads along coordinates of the forest come after the back sweep, because their
// friction depends on what it computes; shared reactions come after the pairs and couplings, whose
// rows they change.

template <class T>
Formulas<T>::Formulas(const System& system) : view_(system) {}

template <class T>
void Formulas<T>::set_design(const std::vector<T>& parameters) {
  view_.set_design(parameters);
}

template <class T>
void Formulas<T>::load(const State<T>& state) {
  view_.load(state);
}

template <class T>
void Formulas<T>::residual(const State<T>& state, VectorX<T>* G, T* g) {
  load(state);
  const StateView<T>& view = view_;
  const System& system = view.system;
  G->setZero(view.layout.columns());
  Workspace<T>& workspace = view.forest.workspace;
  workspace.clear_loads();
  load_bodies(view, &workspace, G);
  sweep_back(view, &workspace, G);
  view.forest.version = view.version;
  load_coordinates(view, &workspace, G);
  for (const BristleContact& contact : system.bristles()) bristle_residual(view, contact, G);
  for (std::size_t c = 0; c < system.controllers().size(); ++c) controller_residual(view, c, G);
  for (const Winding& winding : system.windings()) winding_residual(view, winding, G);
  if (system.sharing().drops()) sharing_residual(view, &workspace, G);
  *g = objective_terms(view, system.integral(), view.design.integral);
}

template <class T>
T Formulas<T>::sample(int controller, bool is_first, VectorX<T>* s) const {
  return sample_controller(view_, controller, is_first, s);
}

template <class T>
void Formulas<T>::constraint_errors(const State<T>& state, VectorX<T>* Phi, VectorX<T>* Phi_rate) {
  load(state);
  const Layout& layout = view_.layout;
  Phi->setZero(layout.m);
  Phi_rate->setZero(layout.m);
  for (std::size_t k = 0; k < view_.design.rows.size(); ++k) {
    const Pair& pair = view_.system.topology().pairs[k];
    if (!layout.is_cut(static_cast<int>(k))) continue;
    const int row = layout.pair_row[k], size = view_.design.rows[k].size();
    pair_errors(static_cast<int>(k), body(pair.body_i), body(pair.body_j),
                Out<T>(*Phi).subspan(row, size), Out<T>(*Phi_rate).subspan(row, size));
  }
  for (std::size_t k = 0; k < view_.design.constants.couplings.size(); ++k)
    coupling_error(view_, k, Phi, Phi_rate);
  for (int b = 0; b < layout.bodies; ++b) norm_error(view_, b, Phi, Phi_rate);
}

template <class T>
void Formulas<T>::pair_errors(int pair, const BodyKinematics<T>& i, const BodyKinematics<T>& j,
                              Out<T> errors, Out<T> rates) const {
  codesign::pair_errors(view_, pair, i, j, errors, rates);
}

template <class T>
void Formulas<T>::track_turns(State<T>* state) {
  const Layout& layout = view_.layout;
  load(*state);
  for (std::size_t p = 0; p < view_.design.constants.pairs.size(); ++p) {
    if (!layout.is_cut(static_cast<int>(p))) continue;
    for (std::size_t e = 0; e < view_.design.constants.pairs[p].coordinates.size(); ++e) {
      const int pair = static_cast<int>(p), element = static_cast<int>(e);
      state->turns[to_index(layout.turn(pair, element))] = view_.coordinate_value(pair, element);
    }
  }
}

// The functions of Formulas that observers and objectives call. Each one calls one function of an
// element.

template <class T>
T Formulas<T>::terminal(const State<T>& state) {
  load(state);
  return objective_terms(view_, view_.system.terminal(), view_.design.terminal);
}

template <class T>
void Formulas<T>::residuals(ObjectivePart part, const State<T>& state, VectorX<T>* residuals) {
  using std::sqrt;
  load(state);
  const bool terminal = part == ObjectivePart::kTerminal;
  const std::vector<ResolvedTerm>& terms =
      terminal ? view_.system.terminal() : view_.system.integral();
  const ObjectiveNumbers<T>& numbers = terminal ? view_.design.terminal : view_.design.integral;
  residuals->resize(to_signed(terms.size()));
  for (std::size_t k = 0; k < terms.size(); ++k)
    (*residuals)[to_signed(k)] =
        is_less(T(0.0), numbers.weights[k], true)
            ? T(sqrt(numbers.weights[k]) *
                loss_root(*terms[k].loss, loss_values(view_, terms, numbers, k)))
            : T(0.0);
}

template <class T>
T Formulas<T>::watched(std::size_t k, const State<T>& state) {
  load(state);
  return watched_value(view_, k);
}

template <class T>
T Formulas<T>::until(const State<T>& state) {
  const Signal* const until = view_.system.until();
  if (!until) return T(0.0);
  load(state);
  return formula_value(view_, *until);
}

template <class T>
void Formulas<T>::watch_switches(const State<T>& state) {
  const std::vector<Signal>& watched = view_.system.watched();
  for (std::size_t k = 0; k < watched.size(); ++k) {
    const WatchedSignal& of = view_.system.study().watched[k];
    const bool of_signal = watched[k].formula && has_switches(watched[k].formula->steps),
               of_time = !of.reference.expression.parameters.empty();
    // A value at the end alone has no instants that switches could move.
    if (of.role == WatchedSignal::Role::kFinal || (!of_signal && !of_time)) continue;
    load(state);
    if (of_signal) formula_value(view_, watched[k]);
    if (of_time) view_.design.watched[k].at(view_.state->t);
  }
}

template <class T>
T Formulas<T>::signal(const Signal& signal, const State<T>& state) {
  load(state);
  return this->signal(signal);
}

template <class T>
T Formulas<T>::signal(const Signal& signal) const {
  return signal_value(view_, signal);
}

template <class T>
const CoordinateMotion<T>& Formulas<T>::coordinate(int pair, int element,
                                                   CoordinateDetail detail) const {
  return view_.coordinate(pair, element, detail);
}

template <class T>
FrictionState<T> Formulas<T>::friction(int pair, int element) const {
  return joint_friction(view_, pair, element);
}

template <class T>
ContactFriction<T> Formulas<T>::contact(int pair) const {
  return contact_at(view_, pair);
}

template <class T>
void Formulas<T>::stuck_slips(VectorX<T>* accelerations, VectorX<T>* limits) const {
  codesign::stuck_slips(view_, accelerations, limits);
}

template <class T>
void Formulas<T>::begin_bristles(VectorX<T>* s) const {
  codesign::begin_bristles(view_, s);
}

template <class T>
T Formulas<T>::effort(int pair, int element) const {
  return joint_effort(view_, pair, element);
}

template <class T>
T Formulas<T>::steady_current(const Winding& winding) const {
  return codesign::steady_current(view_, winding);
}

template <class T>
T Formulas<T>::kinetic_energy() const {
  return codesign::kinetic_energy(view_);
}

template <class T>
T Formulas<T>::potential_energy() const {
  return codesign::potential_energy(view_);
}

template <class T>
T Formulas<T>::power(PowerKind kind) const {
  return total_power(view_, kind);
}

template <class T>
T Formulas<T>::setpoint(int controller) const {
  return view_.design.controllers[to_index(controller)].setpoint.at(view_.state->t).value;
}

template <class T>
T Formulas<T>::controller_output(int controller) const {
  return codesign::controller_output(view_, controller);
}

template <class T>
T Formulas<T>::controller_error(int controller) const {
  return codesign::controller_error(view_, controller);
}

template <class T>
void Formulas<T>::reaction(int pair, Vector3<T>* F, Vector3<T>* torque) const {
  pair_reaction(view_, pair, F, torque);
}

template <class T>
T Formulas<T>::normal_force(int pair) const {
  return codesign::normal_force(view_, pair);
}

template <class T>
T Formulas<T>::multiplier_reaction(const SignalReference& term) const {
  return codesign::multiplier_reaction(view_, term);
}

}  // namespace codesign
