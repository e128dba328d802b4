// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "elements/state_view.h"
#include "forces/compliance.h"
#include "math/arrays.h"

namespace codesign {

// Loads along the coordinates of joints, theory (8). A load L that opposes a coordinate with the
// gradient J adds J^T L to the rows of motion: on both bodies if the pair is cut, in the rows of
// the pair's own coordinates if a body hangs on it, (57).

/// The load J^T L on one body of a pair, if that body belongs to the forest: about its centre of
/// mass, in its axes.
template <class T>
Wrench<T> load_on_side(const BodyKinematics<T>& body, Side side, const LocalRow<T>& J,
                       const T& load) {
  const Vector3<T> along_r = J.template segment<3>(r_offset(side)),
                   along_turn = J.template segment<3>(p_offset(side));
  return {Vector3<T>(body.A.transpose() * along_r) * load, along_turn * load};
}

/// Adds J^T L of a cut pair: to the rows of free bodies, and to Workspace::own of bodies of the
/// forest.
template <class T>
void add_load_on_bodies(const StateView<T>& view, Workspace<T>* workspace, int pair,
                        const LocalRow<T>& J, const T& load, VectorX<T>* G) {
  for (int local = 0; local < kLocalSize; ++local)
    if (const int c = view.column(pair, local); c >= 0) (*G)[c] += J[local] * load;
  if (!view.layout.has_forest()) return;
  const Pair& p = view.pair(pair);
  for (Side side : {Side::kI, Side::kJ}) {
    const int body = side == Side::kI ? p.body_i : p.body_j;
    if (body < 0 || view.layout.is_free(body)) continue;
    workspace->own[to_index(body)] += load_on_side(view.body(body), side, J, load);
  }
}

/// Adds a load L along a joint coordinate. @param motion of that coordinate.
template <class T>
void add_coordinate_load(const StateView<T>& view, Workspace<T>* workspace, int pair, int element,
                         const LocalRow<T>& J, const T& load, VectorX<T>* G) {
  if (const int c = view.layout.element_column(pair, element); c >= 0)
    (*G)[c] += load;
  else
    add_load_on_bodies(view, workspace, pair, J, load, G);
}

/// Adds a load L along any motion of a pair that its coordinates allow, such as a slip. The pair's
/// rows receive the power of the load on body j at unit rates, since body i rests then.
template <class T>
void add_slip_load(const StateView<T>& view, Workspace<T>* workspace, int pair,
                   const LocalRow<T>& J, const T& load, VectorX<T>* G) {
  if (view.layout.is_cut(pair)) {
    add_load_on_bodies(view, workspace, pair, J, load, G);
    return;
  }
  const auto p = to_index(pair);
  const int body = view.layout.forest.body_below[p], c = view.layout.column(body);
  const PairConstants<T>& constants = view.design.constants.pairs[p];
  std::array<T, 6> rows;
  carry_back(load_on_side(view.body(body), Side::kJ, J, load), constants,
             view.motion.poses[to_index(body)], view.state->q.data() + c, rows.data());
  for (std::size_t k = 0; k < constants.steps.size(); ++k) (*G)[c + static_cast<int>(k)] += rows[k];
}

// The study's loads on links, theory (13g). A force with components in the root's axes is added to
// the loads of its body, (7), with b = -F; torques, and loads that turn with their link, are added
// to the rows of motion directly.

template <class T>
T signal_value(const StateView<T>& view, const Signal& signal);

/// A component of a load at the loaded state: of its signal if it has one, else of time.
template <class T>
T load_value(const StateView<T>& view, const Reference<T>& of_time, const Signal& of_signals) {
  return of_signals.formula ? signal_value(view, of_signals) : of_time.at(view.state->t).value;
}

/// A load on a link at the loaded state. Components are in the root link's axes, or in the axes of
/// the body if LinkLoad::turns.
template <class T>
struct LinkWrench {
  /// [N], acting at `point`; [N m]. If LinkLoad::turns the torque includes the moment of the force
  /// about the centre of mass.
  Vector3<T> force, torque;
  Vector3<T> point;  ///< point of action in body coordinates, from the centre of mass [m]
};

template <class T>
LinkWrench<T> link_wrench(const StateView<T>& view, const LinkLoad& load) {
  const LoadNumbers<T>& numbers = view.design.loads[to_index(load.load)];
  const LoadSignals& signals = view.system.load_signals()[to_index(load.load)];
  LinkWrench<T> wrench;
  wrench.point = numbers.point;
  for (int k = 0; k < 3; ++k) {
    const auto axis = to_index(k);
    wrench.force[k] = load_value(view, numbers.force[axis], signals.force[axis]);
    wrench.torque[k] = load_value(view, numbers.torque[axis], signals.torque[axis]);
  }
  if (load.turns) {
    const Matrix3<T>& R = view.design.constants.links[to_index(load.link)].R;
    wrench.force = R * wrench.force;
    wrench.torque = R * wrench.torque + cross<T>(wrench.point, wrench.force);
  }
  return wrench;
}

/// Adds the force in the root's axes to Workspace::loads, f = -F and W = -F s^T; nothing for a load
/// that turns with its link. Must be called before body_residual().
template <class T>
void add_link_load(const StateView<T>& view, Workspace<T>* workspace, std::size_t k) {
  const LinkLoad& load = view.system.link_loads()[k];
  if (load.turns) return;
  const LinkWrench<T> wrench = link_wrench(view, load);
  BodyLoad<T>& on_body = workspace->loads[to_index(load.body)];
  on_body.force -= wrench.force;
  on_body.W -= wrench.force * wrench.point.transpose();
}

/// Adds the terms that add_link_load() leaves out to the rows of motion of a free body, or to
/// Workspace::own: -2 E^T tau, or, for a load that turns with its link, -A f' on r and -2 G^T (s x
/// f' + tau') on p.
template <class T>
void link_load_residual(const StateView<T>& view, Workspace<T>* workspace, std::size_t k,
                        VectorX<T>* G) {
  const LinkLoad& load = view.system.link_loads()[k];
  const LinkWrench<T> wrench = link_wrench(view, load);
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
    G->template segment<4>(c + 3) -=
        T(2.0) * (ground_rate_matrix(on.p).transpose() * wrench.torque);
  }
}

/// F . (r + A s)' + tau . omega [W], positive where the load drives the link; theory (14c).
template <class T>
T link_load_power(const StateView<T>& view, std::size_t k) {
  const LinkLoad& load = view.system.link_loads()[k];
  const LinkWrench<T> wrench = link_wrench(view, load);
  const BodyKinematics<T>& on = view.body(load.body);
  // The torque of a load that turns with its link includes the moment of its force about the centre
  // of mass.
  if (load.turns) return dot<T>(on.A * wrench.force, on.rd) + dot<T>(wrench.torque, body_omega(on));
  const Vector3<T> point_rate = on.rd + on.Ad * wrench.point, omega = ground_omega(on);
  return dot<T>(wrench.force, point_rate) + dot<T>(wrench.torque, omega);
}

}  // namespace codesign
