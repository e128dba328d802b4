// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "elements/contact_friction.h"
#include "elements/state_view.h"
#include "elements/workspace.h"

namespace codesign {

// The rows of the states of a friction law, theory (13e), (13f): sigma - zeta' = 0 [1/s] for each slip coordinate, then sigma - s_dw' = 0
// if the law has a dwell state. A BristleContact with element -1 slips isotropically; else it belongs to one joint coordinate.

/// The slip of a contact: the motion of its coordinates and u [m/s], the rate times the arm (the pin radius for a turn, 1 for a slide).
template <class T>
ContactSlip<T> bristle_slip(const StateView<T>& view, const BristleContact& contact) {
  const auto p = to_index(contact.pair);
  const Pair& pair = view.system.topology().pairs[p];
  if (contact.element < 0) return contact_slip(view.design.constants.pairs[p], view.body(pair.body_i), view.body(pair.body_j));
  const bool turning = view.design.constants.pairs[p].coordinates[to_index(contact.element)].kind == CoordinateConstants<T>::Kind::kTurn;
  ContactSlip<T> slip;
  slip.motion[0] = view.coordinate(contact.pair, contact.element, CoordinateDetail::kRate);
  slip.arm[0] = turning ? view.design.constants.pairs[p].friction.pin_radius : T(1.0);
  slip.u[0] = slip.arm[0] * slip.motion[0].rate;
  return slip;
}

/// The body whose rotation turns the deflections of a contact, or -1 if none does. Deflections are given in the axes of the slip. Body i
/// carries these axes for slides, hinges and planes. For a ball they are the axes of the ground, so that its deflections must be turned
/// with the socket, body i.
template <class T>
int bristle_carrier(const StateView<T>& view, const BristleContact& contact) {
  const Pair& pair = view.pair(contact.pair);
  return contact.element < 0 && pair.kind == PairKind::kSpherical ? pair.body_i : -1;
}

/// omega_i x zeta [1/s], the part of zeta' by which a ball's deflections turn with the socket; zero for all other contacts.
template <class T>
Vector3<T> bristle_turn(const StateView<T>& view, const BristleContact& contact) {
  const int carrier = bristle_carrier(view, contact);
  if (carrier < 0) return Vector3<T>::Zero();
  const Vector3<T> omega = ground_omega(view.body(carrier));
  return cross<T>(omega, view.state->s.template segment<3>(contact.first));
}

/// Sets the rows of the contact's states to sigma - zeta' and sigma - s_dw'.
template <class T>
void bristle_residual(const StateView<T>& view, const BristleContact& contact, VectorX<T>* G) {
  const ContactSlip<T> slip = bristle_slip(view, contact);
  const Bristle<T> law = bristle_law<T>(contact, slip.u, view.state->s, view.constants(contact.pair).friction);
  const Vector3<T> rate = law.rate + bristle_turn(view, contact);
  const auto set = [&](int s, const T& value) { (*G)[view.layout.state_column(s)] = view.state->z[view.layout.state_column(s)] - value; };
  for (int k = 0; k < contact.size; ++k) set(contact.first + k, rate[k]);
  if (contact.dwells()) set(contact.dwell_state(), law.dwell_rate);
}

}  // namespace codesign
