// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_EQUATIONS_FORMULAS_LOOP_H_
#define MECHANISM_CODESIGN_EQUATIONS_FORMULAS_LOOP_H_

#include "elements/body.h"
#include "elements/controller_states.h"
#include "elements/coupling.h"
#include "elements/objective.h"
#include "elements/pair.h"
#include "elements/sampled_control.h"
#include "elements/sharing.h"
#include "equations/formulas.h"

namespace codesign {

// The loop over the elements: the one place that lists them all. Pairs, spring-dampers and constant loads on links come before the bodies,
// because they add to the loads that the bodies turn into rows; shared reactions come after the pairs and couplings, whose rows they
// change.

template <class T>
Formulas<T>::Formulas(const System& system) : view_(system), workspace_(system) {}

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
  workspace_.clear_loads();
  for (std::size_t k = 0; k < view.design.rows.size(); ++k) pair_residual(view, &workspace_, k, G);
  for (std::size_t k = 0; k < view.design.constants.springs.size(); ++k) add_spring_load(view, &workspace_, k, spring_at(view, k));
  for (std::size_t k = 0; k < view.design.wrenches.size(); ++k) add_link_load(view, &workspace_, k);
  for (int b = 0; b < view.layout.bodies; ++b) body_residual(view, &workspace_, static_cast<std::size_t>(b), G);
  for (std::size_t k = 0; k < view.design.wrenches.size(); ++k) link_load_residual(view, k, G);
  for (const Rotor& rotor : system.rotors()) rotor_residual(view, rotor, G);
  for (std::size_t k = 0; k < view.design.constants.couplings.size(); ++k) coupling_residual(view, k, G);
  for (const JointLoad& load : system.loads()) load_residual(view, load, G);
  for (int pair : system.contacts()) contact_residual(view, pair, G);
  for (const BristleContact& contact : system.bristles()) bristle_residual(view, contact, G);
  for (std::size_t c = 0; c < system.controllers().size(); ++c) controller_residual(view, c, G);
  if (system.sharing().drops()) sharing_residual(view, &workspace_, G);
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
    const int row = layout.pair_row[k], size = view_.design.rows[k].size();
    pair_errors(static_cast<int>(k), body(pair.body_i), body(pair.body_j), Out<T>(*Phi).subspan(row, size),
                Out<T>(*Phi_rate).subspan(row, size));
  }
  for (std::size_t k = 0; k < view_.design.constants.couplings.size(); ++k) coupling_error(view_, k, Phi, Phi_rate);
  for (int b = 0; b < layout.bodies; ++b) norm_error(view_, b, Phi, Phi_rate);
}

template <class T>
void Formulas<T>::pair_errors(int pair, const BodyKinematics<T>& i, const BodyKinematics<T>& j, Out<T> errors, Out<T> rates) const {
  codesign::pair_errors(view_, pair, i, j, errors, rates);
}

template <class T>
void Formulas<T>::track_turns(State<T>* state) {
  load(*state);
  const Layout& layout = view_.layout;
  for (std::size_t p = 0; p < view_.design.constants.pairs.size(); ++p)
    for (std::size_t e = 0; e < view_.design.constants.pairs[p].coordinates.size(); ++e) {
      const int pair = static_cast<int>(p), element = static_cast<int>(e);
      state->turns[static_cast<std::size_t>(layout.turn(pair, element))] = view_.coordinate_value(pair, element);
    }
}

}  // namespace codesign

#endif  // MECHANISM_CODESIGN_EQUATIONS_FORMULAS_LOOP_H_
