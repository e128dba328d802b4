// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cassert>

#include "elements/body.h"
#include "elements/contact.h"
#include "elements/joint_load.h"
#include "elements/link_elements.h"
#include "elements/loads.h"
#include "elements/pair.h"
#include "elements/state_view.h"
#include "math/arrays.h"

namespace codesign {

// The wrenches that the joints of a forest transmit, and the rows of motion of their coordinates;
// theory (57). First everything that loads bodies is evaluated, load_bodies(), then the back sweep,
// children before parents. Without a forest load_bodies() is everything that acts on the bodies,
// and the back sweep does nothing.

/// Adds to G and to the workspace what acts on bodies: rows and multipliers of cut pairs and
/// couplings, elements between links, loads on links, inertia of free bodies, rotors, loads and
/// contacts of cut pairs. @param G zero. @param workspace cleared.
template <class T>
void load_bodies(const StateView<T>& view, Workspace<T>* workspace, VectorX<T>* G) {
  const System& system = view.system;
  for (std::size_t k = 0; k < view.design.rows.size(); ++k) pair_residual(view, workspace, k, G);
  add_link_elements(view, workspace);
  for (std::size_t k = 0; k < system.link_loads().size(); ++k) add_link_load(view, workspace, k);
  for (int b = 0; b < view.layout.bodies; ++b) body_residual(view, workspace, to_index(b), G);
  for (std::size_t k = 0; k < system.link_loads().size(); ++k)
    link_load_residual(view, workspace, k, G);
  for (const Rotor& rotor : system.rotors()) rotor_residual(view, workspace, rotor, G);
  for (std::size_t k = 0; k < view.design.constants.couplings.size(); ++k)
    coupling_residual(view, workspace, k, G);
  for (const JointLoad& load : system.loads())
    if (view.layout.is_cut(load.pair)) {
      load_residual(view, workspace, load, G);
      gear_residual(view, load, G);
    }
  for (int pair : system.contacts())
    if (view.layout.is_cut(pair)) contact_residual(view, workspace, pair, G);
}

/// The wrench that a body of the forest needs for its own motion and loads, without its children: J
/// omega' + omega x J omega, m (r'' - g) and the loads in the workspace, which are on the left of
/// G.
template <class T>
Wrench<T> own_wrench(const StateView<T>& view, const Workspace<T>& workspace, int body) {
  const auto b = to_index(body);
  const BodyConstants<T>& c = view.design.constants.bodies[b];
  const AxesMotion<T>& m = view.motion.bodies[b];
  const BodyLoad<T>& load = workspace.loads[b];
  // Its axial vector is the sum of the s x A^T b of (7).
  const Matrix3<T> U = m.A.transpose() * load.W;
  const Wrench<T> inertia = inertia_wrench(c.mass, c.J, m);
  Wrench<T> wrench = workspace.own[b];
  wrench.force += inertia.force + m.A.transpose() * load.force;
  wrench.moment +=
      inertia.moment + Vector3<T>(U(2, 1) - U(1, 2), U(0, 2) - U(2, 0), U(1, 0) - U(0, 1));
  return wrench;
}

/// The back sweep: Workspace::transmitted, the rows of motion of the pairs' coordinates, and what
/// free bodies transmit to their children.
template <class T>
void sweep_back(const StateView<T>& view, Workspace<T>* workspace, VectorX<T>* G) {
  const Layout& layout = view.layout;
  std::vector<Wrench<T>>& transmitted = workspace->transmitted;
  for (Wrench<T>& wrench : transmitted) wrench = {};
  for (std::size_t k = layout.forest.order.size(); k-- > 0;) {
    const int body = layout.forest.order[k], c = layout.column(body);
    const auto b = to_index(body), pair = to_index(layout.forest.pair_above[b]);
    const PairConstants<T>& constants = view.design.constants.pairs[pair];
    transmitted[b] += own_wrench(view, *workspace, body);
    std::array<T, 6> rows;
    const Wrench<T> below = carry_back(transmitted[b], constants, view.motion.poses[b],
                                       view.state->q.data() + c, rows.data());
    for (std::size_t step = 0; step < constants.steps.size(); ++step)
      (*G)[c + static_cast<int>(step)] += rows[step];
    const int parent = view.system.topology().pairs[pair].body_i;
    if (parent >= 0) transmitted[to_index(parent)] += below;
  }
  for (int body = 0; body < layout.bodies && layout.has_forest(); ++body) {
    if (!layout.is_free(body)) continue;
    const Wrench<T>& wrench = transmitted[to_index(body)];
    const int c = layout.column(body);
    G->template segment<3>(c) += view.body(body).A * wrench.force;
    G->template segment<4>(c + 3) +=
        T(2.0) * body_rate_transposed(view.body(body).p, wrench.moment);
  }
}

/// Adds the loads along the coordinates of the forest's pairs, which may depend on the wrenches
/// that the pairs transmit.
template <class T>
void load_coordinates(const StateView<T>& view, Workspace<T>* workspace, VectorX<T>* G) {
  for (const JointLoad& load : view.system.loads())
    if (!view.layout.is_cut(load.pair)) load_residual(view, workspace, load, G);
  for (int pair : view.system.contacts())
    if (!view.layout.is_cut(pair)) contact_residual(view, workspace, pair, G);
}

template <class T>
const Wrench<T>& transmitted_wrench(const StateView<T>& view, int body) {
  ForestMemory<T>& memory = view.forest;
  if (memory.version != view.version) {
    memory.version = view.version;
    memory.workspace.clear_loads();
    memory.unused.setZero(view.layout.columns());
    load_bodies(view, &memory.workspace, &memory.unused);
    sweep_back(view, &memory.workspace, &memory.unused);
  }
  return memory.workspace.transmitted[to_index(body)];
}

}  // namespace codesign
