// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_EQUATIONS_EQUATIONS_CONTACTS_H_
#define MECHANISM_CODESIGN_EQUATIONS_EQUATIONS_CONTACTS_H_

#include "equations/equations.h"

namespace codesign {

// Isotropic friction of tables, planar and spherical joints, theory (13a): the equations get + sum of J_k^T L_k over the slip coordinates.

template <class T>
ContactFriction<T> Equations<T>::contact(int pair, CoordinateDetail detail) const {
  const Pair& p = system_.topology().pairs[static_cast<std::size_t>(pair)];
  return contact_friction(p.kind, constants_.pairs[static_cast<std::size_t>(pair)], body(p.body_i), body(p.body_j), normal_force(pair),
                          system_.bristle(pair, -1), state_->s, detail);
}

template <class T>
bool Equations<T>::slip_moves_r(int pair, std::size_t k) const {
  return constants_.pairs[static_cast<std::size_t>(pair)].slip.coordinates[k].kind == CoordinateConstants<T>::Kind::kSlide;
}

template <class T>
void Equations<T>::append_slip_rate(int pair, const ContactFriction<T>& contact, std::size_t k, const T& factor,
                                    SparseGradient<T>* gradient) const {
  append_local(pair, contact.motion[k].rate_q, factor, slip_moves_r(pair, k), &gradient->position);
  append_local(pair, contact.motion[k].J, factor, slip_moves_r(pair, k), &gradient->velocity);
}

template <class T>
void Equations<T>::append_contact_load(int pair, const ContactFriction<T>& contact, std::size_t k, const T& factor,
                                       SparseGradient<T>* gradient) const {
  const auto row = static_cast<Eigen::Index>(k);
  for (std::size_t l = 0; l < contact.size; ++l)
    append_slip_rate(pair, contact, l, T(factor * contact.by_rate(row, static_cast<Eigen::Index>(l))), gradient);
  append_normal_gradient(pair, contact.normal.F, contact.normal.torque, T(factor * contact.by_normal[row]), gradient);
  if (const BristleContact* bristle = system_.bristle(pair, -1))
    append_bristle_states(*bristle, factor * contact.by_zeta.row(row).transpose(), factor * contact.by_dwell[row], gradient);
}

template <class T>
void Equations<T>::contact_residual(int pair, VectorX<T>* G) {
  const ContactFriction<T> c = contact(pair, CoordinateDetail::kRate);
  for (std::size_t k = 0; k < c.size; ++k)
    for (int local = 0; local < kLocalSize; ++local)
      if (const int row = column(pair, local); row >= 0) (*G)[row] += c.motion[k].J[local] * c.load[static_cast<Eigen::Index>(k)];
}

template <class T>
template <class Sink>
void Equations<T>::assemble_contact(int pair, Sink* sink) {
  const auto& slip = constants_.pairs[static_cast<std::size_t>(pair)].slip.coordinates;
  const ContactFriction<T> c = contact(pair);
  for (std::size_t k = 0; k < c.size; ++k) {
    gradient_.clear();
    append_contact_load(pair, c, k, T(1.0), &gradient_);
    for (int local = 0; local < kLocalSize; ++local) {
      const int row = column(pair, local);
      if (row >= 0 && (local % kBodySize >= 3 || slip_moves_r(pair, k))) add_row(row, c.motion[k].J[local], gradient_, sink);
    }
    assemble_load_curvature(pair, slip[k], c.load[static_cast<Eigen::Index>(k)], sink);
  }
}

template <class T>
T Equations<T>::contact_term(const SignalReference& term, const T& factor, SparseGradient<T>* gradient) {
  const ContactFriction<T> c = contact(term.pair);
  const bool friction = term.kind == SignalKind::kContactFriction;
  const T length = friction ? c.magnitude() : c.speed();
  if (gradient) {
    // At rest the length has no derivative; zero is taken for it, as length_of() does.
    const T scale = is_less(T(0.0), length, true) ? T((friction ? -factor : factor) / length) : T(0.0);
    for (std::size_t k = 0; k < c.reported; ++k) {
      const T load = c.load[static_cast<Eigen::Index>(k)];
      if (friction) append_contact_load(term.pair, c, k, T(scale * load), gradient);
      if (!friction) append_slip_rate(term.pair, c, k, T(scale * c.motion[k].rate), gradient);
    }
  }
  return friction ? T(-factor * length) : T(factor * length);
}

}  // namespace codesign

#endif  // MECHANISM_CODESIGN_EQUATIONS_EQUATIONS_CONTACTS_H_
