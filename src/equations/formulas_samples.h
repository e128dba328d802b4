// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "elements/forest.h"
#include "elements/objective.h"
#include "equations/formulas.h"

namespace codesign {

// The functions of Formulas that observers and objectives call. Each one calls one function of an element.

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
  const std::vector<ResolvedTerm>& terms = terminal ? view_.system.terminal() : view_.system.integral();
  const ObjectiveNumbers<T>& numbers = terminal ? view_.design.terminal : view_.design.integral;
  residuals->resize(static_cast<Eigen::Index>(terms.size()));
  for (std::size_t k = 0; k < terms.size(); ++k)
    (*residuals)[static_cast<Eigen::Index>(k)] =
        is_less(T(0.0), numbers.weights[k], true)
            ? T(sqrt(numbers.weights[k]) * signal_error(view_, terms[k].signal, numbers.references[k]))
            : T(0.0);
}

template <class T>
T Formulas<T>::watched(std::size_t k, const State<T>& state) {
  load(state);
  return watched_value(view_, k);
}

template <class T>
T Formulas<T>::signal(const Signal& signal, const State<T>& state) {
  load(state);
  return signal_value(view_, signal);
}

template <class T>
const CoordinateMotion<T>& Formulas<T>::coordinate(int pair, int element, CoordinateDetail detail) const {
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
SpringForce<T> Formulas<T>::spring(std::size_t k) const {
  return spring_at(view_, k);
}

template <class T>
T Formulas<T>::effort(int pair, int element) const {
  return joint_effort(view_, pair, element);
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
  return view_.design.controllers[static_cast<std::size_t>(controller)].setpoint.at(view_.state->t).value;
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
