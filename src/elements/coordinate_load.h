// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "elements/state_view.h"
#include "elements/workspace.h"

namespace codesign {

// Loads along the coordinates of joints, theory (8). A load L that opposes a coordinate with the gradient J adds J^T L to the rows of
// motion: on both bodies if the pair is cut, in the rows of the pair's own coordinates if a body hangs on it, (57).

/// The load J^T L on one body of a pair, if that body belongs to the forest: about its centre of mass, in its axes.
template <class T>
Wrench<T> load_on_side(const BodyKinematics<T>& body, Side side, const LocalRow<T>& J, const T& load) {
  const Vector3<T> along_r = J.template segment<3>(r_offset(side)), along_turn = J.template segment<3>(p_offset(side));
  return {Vector3<T>(body.A.transpose() * along_r) * load, along_turn * load};
}

/// Adds J^T L of a cut pair: to the rows of free bodies, and to Workspace::own of bodies of the forest.
template <class T>
void add_load_on_bodies(const StateView<T>& view, Workspace<T>* workspace, int pair, const LocalRow<T>& J, const T& load, VectorX<T>* G) {
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
void add_coordinate_load(const StateView<T>& view, Workspace<T>* workspace, int pair, int element, const LocalRow<T>& J, const T& load,
                         VectorX<T>* G) {
  if (const int c = view.layout.element_column(pair, element); c >= 0)
    (*G)[c] += load;
  else
    add_load_on_bodies(view, workspace, pair, J, load, G);
}

/// Adds a load L along any motion of a pair that its coordinates allow, such as a slip. The pair's rows receive the power of the load on
/// body j at unit rates, since body i rests then.
template <class T>
void add_slip_load(const StateView<T>& view, Workspace<T>* workspace, int pair, const LocalRow<T>& J, const T& load, VectorX<T>* G) {
  if (view.layout.is_cut(pair)) {
    add_load_on_bodies(view, workspace, pair, J, load, G);
    return;
  }
  const auto p = to_index(pair);
  const int body = view.layout.forest.body_below[p], c = view.layout.column(body);
  const PairConstants<T>& constants = view.design.constants.pairs[p];
  std::array<T, 6> rows;
  carry_back(load_on_side(view.body(body), Side::kJ, J, load), constants, view.motion.poses[to_index(body)], view.state->q.data() + c,
             rows.data());
  for (std::size_t k = 0; k < constants.steps.size(); ++k) (*G)[c + static_cast<int>(k)] += rows[k];
}

}  // namespace codesign
