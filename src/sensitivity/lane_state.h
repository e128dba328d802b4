// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "integration/increment.h"
#include "sensitivity/lane_directions.h"
#include "system/state.h"

namespace codesign {

/// Combines values and directional derivatives in a state of lanes. @param directions in the order of IncrementLayout. @param state must
/// have the sizes of `values`.
template <int N>
void load_lanes(const IncrementLayout& at, const State<double>& values, const Directions<N>& directions, State<Lanes<N>>* state) {
  const auto load = [&directions](const VectorX<double>& value, int first, VectorX<Lanes<N>>* lanes) {
    for (Eigen::Index k = 0; k < value.size(); ++k) {
      (*lanes)[k].a = value[k];
      (*lanes)[k].directions() = directions.col(first + k);
    }
  };
  state->t = values.t;
  state->turns = values.turns;
  load(values.q, at.x(), &state->q);
  load(values.s, at.s(), &state->s);
  load(values.v, at.v(), &state->v);
  load(values.z, at.z(), &state->z);
}

}  // namespace codesign
