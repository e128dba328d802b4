// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_EQUATIONS_EQUATIONS_BRISTLES_H_
#define MECHANISM_CODESIGN_EQUATIONS_EQUATIONS_BRISTLES_H_

#include "equations/equations.h"

namespace codesign {

// Rows of the states of friction laws, theory (13e), (13f): sigma - zeta' = 0 for each deflection, then sigma - s_dw' = 0.

template <class T>
ContactSlip<T> Equations<T>::bristle_slip(const BristleContact& contact, CoordinateDetail detail) const {
  const auto p = static_cast<std::size_t>(contact.pair);
  const Pair& pair = system_.topology().pairs[p];
  if (contact.element < 0) return contact_slip(constants_.pairs[p], body(pair.body_i), body(pair.body_j), detail);
  const bool turning =
      constants_.pairs[p].coordinates[static_cast<std::size_t>(contact.element)].kind == CoordinateConstants<T>::Kind::kTurn;
  ContactSlip<T> slip;
  slip.motion[0] = coordinate(contact.pair, contact.element, detail);
  slip.arm[0] = turning ? constants_.pairs[p].friction.pin_radius : T(1.0);
  slip.u[0] = slip.arm[0] * slip.motion[0].rate;
  return slip;
}

// The axes of slides and hinges are carried by body i; a ball's are the ground's, so that its deflections must be turned with its socket.
template <class T>
int Equations<T>::bristle_carrier(const BristleContact& contact) const {
  const Pair& pair = system_.topology().pairs[static_cast<std::size_t>(contact.pair)];
  return contact.element < 0 && pair.kind == PairKind::kSpherical ? pair.body_i : -1;
}

template <class T>
void Equations<T>::append_bristle_slip(const BristleContact& contact, const ContactSlip<T>& slip, const Vector3<T>& by_u,
                                       SparseGradient<T>* gradient) const {
  for (int k = 0; k < contact.size; ++k) {
    const CoordinateMotion<T>& motion = slip.motion[static_cast<std::size_t>(k)];
    const T factor = by_u[k] * slip.arm[k];
    const bool with_r =
        contact.element < 0 ? slip_moves_r(contact.pair, static_cast<std::size_t>(k)) : coordinate_moves_r(contact.pair, contact.element);
    append_local(contact.pair, motion.rate_q, factor, with_r, &gradient->position);
    append_local(contact.pair, motion.J, factor, with_r, &gradient->velocity);
  }
}

template <class T>
void Equations<T>::append_bristle_states(const BristleContact& contact, const Vector3<T>& by_zeta, const T& by_dwell,
                                         SparseGradient<T>* gradient) const {
  for (int k = 0; k < contact.size; ++k) gradient->position.push_back({layout_.position_column(contact.first + k), by_zeta[k]});
  if (contact.dwells()) gradient->position.push_back({layout_.position_column(contact.dwell_state()), by_dwell});
}

template <class T>
void Equations<T>::append_spin(int index, const Vector3<T>& factor, SparseGradient<T>* gradient) const {
  const BodyKinematics<T>& k = body(index);
  const Vector4<T> by_p = T(-2.0) * (ground_rate_matrix(k.pd).transpose() * factor);
  const Vector4<T> by_pd = T(2.0) * (ground_rate_matrix(k.p).transpose() * factor);
  for (int e = 0; e < 4; ++e) {
    gradient->position.push_back({kBodySize * index + 3 + e, by_p[e]});
    gradient->velocity.push_back({kBodySize * index + 3 + e, by_pd[e]});
  }
}

template <class T>
void Equations<T>::bristle_residual(const BristleContact& contact, VectorX<T>* G) {
  const ContactSlip<T> slip = bristle_slip(contact, CoordinateDetail::kRate);
  const Bristle<T> law = bristle_law<T>(contact, slip.u, state_->s, constants_.pairs[static_cast<std::size_t>(contact.pair)].friction);
  const Vector3<T> rate = law.rate + bristle_turn(contact);
  const auto set = [&](int s, const T& value) { (*G)[layout_.state_column(s)] = state_->z[layout_.state_column(s)] - value; };
  for (int k = 0; k < contact.size; ++k) set(contact.first + k, rate[k]);
  if (contact.dwells()) set(contact.dwell_state(), law.dwell_rate);
}

template <class T>
Vector3<T> Equations<T>::bristle_turn(const BristleContact& contact) const {
  const int carrier = bristle_carrier(contact);
  if (carrier < 0) return Vector3<T>::Zero();
  const Vector3<T> omega = T(2.0) * (ground_rate_matrix(body(carrier).p) * body(carrier).pd);
  return cross<T>(omega, state_->s.template segment<3>(contact.first));
}

template <class T>
template <class Sink>
void Equations<T>::assemble_bristle(const BristleContact& contact, Sink* sink) {
  const ContactSlip<T> slip = bristle_slip(contact, CoordinateDetail::kGradient);
  const Bristle<T> law = bristle_law<T>(contact, slip.u, state_->s, constants_.pairs[static_cast<std::size_t>(contact.pair)].friction);
  const int carrier = bristle_carrier(contact);
  Matrix3<T> by_zeta = law.rate_zeta, by_omega = Matrix3<T>::Zero();
  if (carrier >= 0) {
    const Vector3<T> omega = T(2.0) * (ground_rate_matrix(body(carrier).p) * body(carrier).pd);
    const Vector3<T> zeta = state_->s.template segment<3>(contact.first);
    for (int k = 0; k < 3; ++k) {
      by_zeta.col(k) += cross<T>(omega, Vector3<T>::Unit(k));
      by_omega.col(k) = cross<T>(Vector3<T>::Unit(k), zeta);
    }
  }
  const auto add = [&](int s, const Vector3<T>& by_u, const Vector3<T>& zeta, const T& by_dwell) {
    const int row = layout_.state_column(s);
    gradient_.clear();
    append_bristle_slip(contact, slip, by_u, &gradient_);
    append_bristle_states(contact, zeta, by_dwell, &gradient_);
    if (carrier >= 0 && s != contact.dwell_state()) append_spin(carrier, by_omega.row(s - contact.first).transpose(), &gradient_);
    sink->rate(row, row, T(1.0));
    add_row(row, T(-1.0), gradient_, sink);
  };
  for (int k = 0; k < contact.size; ++k) add(contact.first + k, law.rate_u.row(k).transpose(), by_zeta.row(k).transpose(), T(0.0));
  if (contact.dwells()) add(contact.dwell_state(), law.dwell_u, Vector3<T>(Vector3<T>::Zero()), law.dwell_dwell);
}

}  // namespace codesign

#endif  // MECHANISM_CODESIGN_EQUATIONS_EQUATIONS_BRISTLES_H_
