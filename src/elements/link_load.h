// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "elements/state_view.h"
#include "elements/workspace.h"

namespace codesign {

// The study's constant loads on links, theory (13g). A force with components in the root's axes is added to the loads of its body, (7),
// with b = -F; torques, and loads that turn with their link, are added to the rows of motion directly.

/// Adds the force in the root's axes to Workspace::loads, f = -F and W = -F s^T; nothing for a load that turns with its link. Must be
/// called before body_residual().
template <class T>
void add_link_load(const StateView<T>& view, Workspace<T>* workspace, std::size_t k) {
  const LinkLoad& load = view.system.link_loads()[k];
  if (load.turns) return;
  BodyLoad<T>& on_body = workspace->loads[to_index(load.body)];
  on_body.force -= view.design.wrenches[k].force;
  on_body.W -= view.design.wrenches[k].force * view.design.wrenches[k].point.transpose();
}

/// Adds the terms that add_link_load() leaves out to the rows of motion of a free body, or to Workspace::own: -2 E^T tau, or, for a load
/// that turns with its link, -A f' on r and -2 G^T (s x f' + tau') on p.
template <class T>
void link_load_residual(const StateView<T>& view, Workspace<T>* workspace, std::size_t k, VectorX<T>* G) {
  const LinkLoad& load = view.system.link_loads()[k];
  const ConstantWrench<T>& wrench = view.design.wrenches[k];
  const BodyKinematics<T>& on = view.body(load.body);
  if (on.in_forest) {
    Wrench<T>& own = workspace->own[to_index(load.body)];
    if (load.turns) own.force -= wrench.force;
    own.moment -= load.turns ? wrench.torque : Vector3<T>(on.A.transpose() * wrench.torque);
    return;
  }
  const int c = view.layout.column(load.body);
  if (load.turns) {
    G->template segment<3>(c) -= on.A * wrench.force;
    G->template segment<4>(c + 3) -= T(2.0) * body_rate_transposed(on.p, wrench.torque);
  } else {
    G->template segment<4>(c + 3) -= T(2.0) * (ground_rate_matrix(on.p).transpose() * wrench.torque);
  }
}

/// F . (r + A s)' + tau . omega [W], positive where the load drives the link; theory (14c).
template <class T>
T link_load_power(const StateView<T>& view, std::size_t k) {
  const LinkLoad& load = view.system.link_loads()[k];
  const ConstantWrench<T>& wrench = view.design.wrenches[k];
  const BodyKinematics<T>& on = view.body(load.body);
  // The torque of a load that turns with its link includes the moment of its force about the centre of mass.
  if (load.turns) return dot<T>(on.A * wrench.force, on.rd) + dot<T>(wrench.torque, body_omega(on));
  const Vector3<T> point_rate = on.rd + on.Ad * wrench.point, omega = ground_omega(on);
  return dot<T>(wrench.force, point_rate) + dot<T>(wrench.torque, omega);
}

}  // namespace codesign
