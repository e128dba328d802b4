// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>

#include "elements/loads.h"
#include "elements/normal_force.h"
#include "elements/state_view.h"
#include "forces/bristles.h"
#include "forces/friction_curves.h"
#include "joints/coordinate.h"
#include "math/arrays.h"

namespace codesign {

/// The friction of one joint coordinate at one instant, for observers; theory (13).
template <class T>
struct FrictionState {
  T velocity{0.0};  ///< rate of the coordinate, child relative to parent [m/s or rad/s]
  T normal{0.0};    ///< normal force N [N]; zero for `<dynamics friction>`
  /// L, positive against the motion, viscous part included [N or N m]; the child feels -L
  T load{0.0};
};

/// Isotropic friction of one pair (a table, a planar or a spherical joint) at one instant; theory
/// (13a). Vectors have one entry per slip coordinate; entries beyond `size` are zero.
template <class T>
struct ContactFriction {
  /// number of slip coordinates: 2 for a table, 3 for planar and spherical joints
  std::size_t size = 0;
  /// the first ones make up the reported speed and friction: two slides of a plane, all three of a
  /// ball
  std::size_t reported = 0;
  std::array<CoordinateMotion<T>, 3> motion;
  T normal{0.0};  ///< N [N], theory (12)
  /// L, positive against the rate, viscous part included [N or N m]
  Vector3<T> load = Vector3<T>::Zero();

  /// Speed of the joint's point [m/s], or |omega| of a ball [rad/s].
  T speed() const {
    Vector3<T> rate = Vector3<T>::Zero();
    for (std::size_t k = 0; k < reported; ++k) rate[to_signed(k)] = motion[k].rate;
    return length_of<T, 3>(rate);
  }
  /// Magnitude of the friction force [N], or of the friction torque of a ball [N m].
  T magnitude() const {
    Vector3<T> part = load;
    if (reported < 3) part[2] = T(0.0);
    return length_of<T, 3>(part);
  }
  /// Power that friction takes from the motion, L . rates [W].
  T power() const {
    T sum(0.0);
    for (std::size_t k = 0; k < size; ++k) sum += load[to_signed(k)] * motion[k].rate;
    return sum;
  }
};

/// The slip of a contact in one to three coordinates: their motion, their arms (1 for a slide, a
/// radius [m] for a turn), and u, each rate times its arm [m/s].
template <class T>
struct ContactSlip {
  std::array<CoordinateMotion<T>, 3> motion{};
  Vector3<T> arm = Vector3<T>::Zero(), u = Vector3<T>::Zero();
};

/// The slip of a pair with isotropic friction. @param i, j motion of its two bodies.
template <class T>
ContactSlip<T> contact_slip(const PairConstants<T>& pair, const BodyKinematics<T>& i,
                            const BodyKinematics<T>& j,
                            CoordinateDetail detail = CoordinateDetail::kRate) {
  ContactSlip<T> slip;
  for (std::size_t k = 0; k < pair.slip.coordinates.size(); ++k) {
    const auto e = to_signed(k);
    slip.motion[k] = coordinate_motion(pair, pair.slip.coordinates[k], i, j, detail);
    slip.arm[e] = pair.slip.arm[k];
    slip.u[e] = slip.arm[e] * slip.motion[k].rate;
  }
  return slip;
}

// The rows of the states of a friction law, theory (13e), (13f): sigma - zeta' = 0 [1/s] for each
// slip coordinate, then sigma - s_dw' = 0 if the law has a dwell state. A BristleContact with
// element -1 slips isotropically; else it belongs to one joint coordinate.

/// The numbers of the friction law of a contact.
template <class T>
const FrictionConstants<T>& bristle_numbers(const StateView<T>& view,
                                            const BristleContact& contact) {
  return contact.gear ? view.dynamics(contact.pair, contact.element).gear.slip
                      : view.constants(contact.pair).friction;
}

/// The slip of a contact: the motion of its coordinates and u [m/s], the rate times the arm (the
/// pin radius for a turn, 1 for a slide and for the flanks of a gear).
template <class T>
ContactSlip<T> bristle_slip(const StateView<T>& view, const BristleContact& contact,
                            CoordinateDetail detail = CoordinateDetail::kRate) {
  const auto p = to_index(contact.pair);
  const Pair& pair = view.system.topology().pairs[p];
  if (contact.element < 0)
    return contact_slip(view.design.constants.pairs[p], view.body(pair.body_i),
                        view.body(pair.body_j), detail);
  const bool turning = view.design.constants.pairs[p].coordinates[to_index(contact.element)].kind ==
                       CoordinateConstants<T>::Kind::kTurn;
  ContactSlip<T> slip;
  slip.motion[0] = view.coordinate(contact.pair, contact.element, detail);
  slip.arm[0] = turning && !contact.gear ? bristle_numbers(view, contact).pin_radius : T(1.0);
  slip.u[0] = slip.arm[0] * slip.motion[0].rate;
  return slip;
}

/// Of all contacts that start stuck, one entry per slip coordinate: the slip's acceleration
/// [m/s^2], and the largest |zeta| of a contact that has rested [-]; theory (13h).
template <class T>
void stuck_slips(const StateView<T>& view, VectorX<T>* accelerations, VectorX<T>* limits) {
  const System& system = view.system;
  int size = 0;
  for (const StuckContact& stuck : system.stuck()) size += system.bristles()[stuck.bristle].size;
  accelerations->resize(size);
  limits->resize(size);
  int row = 0;
  for (const StuckContact& stuck : system.stuck()) {
    const BristleContact& contact = system.bristles()[stuck.bristle];
    const ContactSlip<T> slip = bristle_slip(view, contact, CoordinateDetail::kAcceleration);
    for (int k = 0; k < contact.size; ++k, ++row) {
      (*accelerations)[row] = slip.arm[k] * slip.motion[to_index(k)].acceleration;
      (*limits)[row] = bristle_numbers(view, contact).mu_static;
    }
  }
}

/// Sets the states of the friction laws to steady sliding at the loaded state, theory (13j), but
/// those of contacts that start stuck and those that the study gives. @param s all extra states.
template <class T>
void begin_bristles(const StateView<T>& view, VectorX<T>* s) {
  const System& system = view.system;
  for (std::size_t k = 0; k < system.bristles().size(); ++k) {
    const BristleContact& contact = system.bristles()[k];
    if (!contact.model->steady || !system.begins_steadily(k)) continue;
    const BristleState<T> steady =
        contact.model->steady.of<T>(bristle_slip(view, contact).u, bristle_numbers(view, contact));
    for (int j = 0; j < contact.size; ++j) (*s)[contact.first + j] = steady.zeta[j];
    if (contact.dwells()) (*s)[contact.dwell_state()] = steady.dwell;
  }
}

/// The body whose rotation turns the deflections of a contact, or -1 if none does. Deflections are
/// given in the axes of the slip. Body i carries these axes for slides, hinges and planes. For a
/// ball they are the axes of the ground, so that its deflections must be turned with the socket,
/// body i.
template <class T>
int bristle_carrier(const StateView<T>& view, const BristleContact& contact) {
  const Pair& pair = view.pair(contact.pair);
  return contact.element < 0 && pair.kind == PairKind::kSpherical ? pair.body_i : -1;
}

/// omega_i x zeta [1/s], the part of zeta' by which a ball's deflections turn with the socket; zero
/// for all other contacts.
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
  const Bristle<T> law =
      bristle_law<T>(contact, slip.u, view.state->s, bristle_numbers(view, contact));
  const Vector3<T> rate = law.rate + bristle_turn(view, contact);
  const auto set = [&](int s, const T& value) {
    (*G)[view.layout.state_column(s)] = view.state->z[view.layout.state_column(s)] - value;
  };
  for (int k = 0; k < contact.size; ++k) set(contact.first + k, rate[k]);
  if (contact.dwells()) set(contact.dwell_state(), law.dwell_rate);
}

// Isotropic friction of tables, planar and spherical joints, theory (13a). The loads L_k oppose the
// slip rates, so the sum of J_k^T L_k over the slip coordinates k is added to the rows of motion.

/// Slip, normal force and loads of a pair among System::contacts() at the loaded state: L = arm
/// sigma N u plus the viscous part, with sigma = S(|u|)/|u|, or L = arm mu N for a law with states,
/// theory (13e), (13f).
template <class T>
ContactFriction<T> contact_at(const StateView<T>& view, int pair) {
  const Pair& p = view.system.topology().pairs[to_index(pair)];
  const PairConstants<T>& constants = view.design.constants.pairs[to_index(pair)];
  const FrictionConstants<T>& f = constants.friction;
  const ContactSlip<T> slip = contact_slip(constants, view.body(p.body_i), view.body(p.body_j));
  ContactFriction<T> contact;
  contact.motion = slip.motion;
  contact.normal = normal_force(view, pair);
  contact.size = constants.slip.coordinates.size();
  contact.reported = to_index(p.kind->slips_of_the_point);
  const auto sigma = [&](const T& square) {
    return per_speed<T>(view.system.friction_law(pair), square, f);
  };
  // The friction per slip direction, without the arm [N].
  const BristleContact* bristle = view.system.bristle(pair, -1);
  const Vector3<T> load =
      bristle ? Vector3<T>(contact.normal * bristle_law<T>(*bristle, slip.u, view.state->s, f).mu)
              : isotropic_friction<T, 3>(slip.u, contact.normal, sigma);
  for (std::size_t k = 0; k < contact.size; ++k) {
    const auto e = to_signed(k);
    contact.load[e] = slip.arm[e] * load[e] + constants.slip.viscous[k] * contact.motion[k].rate;
  }
  return contact;
}

/// Adds the sum of J_k^T L_k to the rows of motion of both bodies.
template <class T>
void contact_residual(const StateView<T>& view, Workspace<T>* workspace, int pair, VectorX<T>* G) {
  const ContactFriction<T> c = contact_at(view, pair);
  for (std::size_t k = 0; k < c.size; ++k)
    add_slip_load(view, workspace, pair, c.motion[k].J, T(c.load[to_signed(k)]), G);
}

}  // namespace codesign
