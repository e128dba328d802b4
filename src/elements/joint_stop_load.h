// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "elements/state_view.h"
#include "forces/joint_stop.h"

namespace codesign {

// Joint stops, theory (13d): `<limit lower upper>` in a study that enforces it.

/// L of both stops of a coordinate [N or N m]: positive beyond the upper limit, negative beyond the lower one.
/// @param rate of the coordinate. @param dissipation c of (13d) [s/m or s/rad]; 0 leaves the elastic part.
template <class T>
T stop_load(const StateView<T>& view, const JointLoad& load, const T& rate, double dissipation) {
  const JointDynamicsConstants<T>& d =
      view.design.constants.pairs[static_cast<std::size_t>(load.pair)].dynamics[static_cast<std::size_t>(load.element)];
  const LimitOptions& stop = view.system.study().limits;
  const T position = view.coordinate_value(load.pair, load.element), below = d.lower - position, above = position - d.upper;
  const T at_upper = joint_stop(above, rate, stop.stiffness, dissipation, stop.width);
  return at_upper - joint_stop(below, T(-rate), stop.stiffness, dissipation, stop.width);
}

/// The part of stop_load() that takes energy from the motion, k delta (h - 1): the load less its elastic part.
template <class T>
T stop_dissipation(const StateView<T>& view, const JointLoad& load, const T& rate) {
  const T elastic = stop_load(view, load, rate, 0.0);
  return stop_load(view, load, rate, view.system.study().limits.dissipation) - elastic;
}

}  // namespace codesign
