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

/// Slip, normal force and loads L_k of a pair among System::contacts() at the loaded state.
template <class T>
ContactFriction<T> contact_at(const StateView<T>& view, int pair) {
  const Pair& p = view.system.topology().pairs[static_cast<std::size_t>(pair)];
  return contact_friction(p.kind, view.design.constants.pairs[static_cast<std::size_t>(pair)], view.body(p.body_i), view.body(p.body_j),
                          normal_force(view, pair), view.system.bristle(pair, -1), view.state->s);
}

/// Adds the sum of J_k^T L_k to the rows of motion of both bodies.
template <class T>
void contact_residual(const StateView<T>& view, Workspace<T>* workspace, int pair, VectorX<T>* G) {
  const ContactFriction<T> c = contact_at(view, pair);
  for (std::size_t k = 0; k < c.size; ++k) add_slip_load(view, workspace, pair, c.motion[k].J, T(c.load[static_cast<Eigen::Index>(k)]), G);
}

}  // namespace codesign
