// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "joints/joint_sweep.h"
#include "joints/pair_rows.h"
#include "system/system.h"

namespace codesign {

/// Memory that the elements write to during one evaluation of the equations: the loads on the bodies, which several elements add up.
///
/// Order within one evaluation: clear_loads(); then every element that adds loads (pairs, spring-dampers, constant loads on links); then
/// the bodies, which turn the sums into rows of the residual, theory (7).
template <class T>
struct Workspace {
  explicit Workspace(const System& system) {
    loads.resize(to_index(system.layout().bodies));
    if (system.layout().has_forest()) {
      own.resize(loads.size());
      transmitted.resize(loads.size());
    }
    if (!system.sharing().drops()) return;
    shared_loads = loads;
    displaced.resize(loads.size() + 1);
    displaced.back().at_rest = true;
  }

  /// Sets `loads` to zero, before the first element adds to them.
  void clear_loads() {
    for (BodyLoad<T>& load : loads) {
      load.force.setZero();
      load.W.setZero();
    }
    for (Wrench<T>& wrench : own) wrench = {};
  }
  /// The sum of the loads on a body, to which elements add theirs; null for the ground, whose loads are not needed.
  BodyLoad<T>* load_on(int body) { return body < 0 ? nullptr : &loads[to_index(body)]; }
  /// The same for `shared_loads`.
  BodyLoad<T>* shared_load_on(int body) { return body < 0 ? nullptr : &shared_loads[to_index(body)]; }
  /// A body of `displaced`; -1 is the ground.
  const BodyKinematics<T>& displaced_body(int body) const { return body < 0 ? displaced.back() : displaced[to_index(body)]; }

  /// Per body: f and W of multipliers, spring-dampers and constant forces. They are terms of G, on the left, so the body feels -f.
  std::vector<BodyLoad<T>> loads;
  /// Per body of a system with a forest: further loads about its centre of mass, in its axes, with the same sign. Used of bodies of the
  /// forest only.
  std::vector<Wrench<T>> own;
  /// Per body of a system with a forest, after the back sweep: of a body of the forest the wrench that its joint transmits to it, of a free
  /// body the sum of the wrenches that its children need; theory (57).
  std::vector<Wrench<T>> transmitted;
  /// Per body: f and W of the unknowns eta of shared reactions, theory (23b). Empty if no row is dropped, as is `displaced`.
  std::vector<BodyLoad<T>> shared_loads;
  /// Per body, the ground last: its position without velocity, and the displacement w of (23b) in place of the acceleration.
  std::vector<BodyKinematics<T>> displaced;
};

}  // namespace codesign
