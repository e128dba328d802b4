// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "elements/bristle.h"
#include "elements/contact_friction.h"
#include "elements/coordinate_load.h"
#include "elements/normal_force.h"
#include "elements/state_view.h"
#include "elements/workspace.h"

namespace codesign {

// Isotropic friction of tables, planar and spherical joints, theory (13a). The loads L_k oppose the slip rates, so the rows of motion get
// + sum of J_k^T L_k over the slip coordinates k.

/// Slip, normal force and loads of a pair among System::contacts() at the loaded state: L = arm sigma N u plus the viscous part, with
/// sigma = S(|u|)/|u|, or L = arm mu N for a law with states, theory (13e), (13f).
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
  const auto sigma = [&](const T& square) { return per_speed<T>(view.system.friction_law(pair), square, f); };
  // The friction per slip direction, without the arm [N].
  const BristleContact* bristle = view.system.bristle(pair, -1);
  const Vector3<T> load = bristle ? Vector3<T>(contact.normal * bristle_law<T>(*bristle, slip.u, view.state->s, f).mu)
                                  : isotropic_friction<T, 3>(slip.u, contact.normal, sigma);
  for (std::size_t k = 0; k < contact.size; ++k) {
    const auto e = static_cast<Eigen::Index>(k);
    contact.load[e] = slip.arm[e] * load[e] + constants.slip.viscous[k] * contact.motion[k].rate;
  }
  return contact;
}

/// Adds the sum of J_k^T L_k to the rows of motion of both bodies.
template <class T>
void contact_residual(const StateView<T>& view, Workspace<T>* workspace, int pair, VectorX<T>* G) {
  const ContactFriction<T> c = contact_at(view, pair);
  for (std::size_t k = 0; k < c.size; ++k) add_slip_load(view, workspace, pair, c.motion[k].J, T(c.load[static_cast<Eigen::Index>(k)]), G);
}

}  // namespace codesign
