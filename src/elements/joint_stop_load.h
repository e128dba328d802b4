// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_ELEMENTS_JOINT_STOP_LOAD_H_
#define MECHANISM_CODESIGN_ELEMENTS_JOINT_STOP_LOAD_H_

#include "elements/gradient_rows.h"
#include "elements/state_view.h"
#include "forces/joint_stop.h"

namespace codesign {

// Joint stops, theory (13d): `<limit lower upper>` in a study that enforces it.

/// L of both stops of a coordinate [N or N m]: positive beyond the upper limit, negative beyond the lower one. Appends its gradient;
/// `motion` then needs detail kAll. @param dissipation c of (13d) [s/m or s/rad]; 0 leaves the elastic part.
template <class T>
T stop_load(const StateView<T>& view, const JointLoad& load, const CoordinateMotion<T>& motion, double dissipation,
            OptionalGradient<T> gradient) {
  const JointDynamicsConstants<T>& d =
      view.design.constants.pairs[static_cast<std::size_t>(load.pair)].dynamics[static_cast<std::size_t>(load.element)];
  const LimitOptions& stop = view.system.study().limits;
  const T position = view.coordinate_value(load.pair, load.element), below = d.lower - position, above = position - d.upper;
  const StopForce<T> at_upper = joint_stop(above, motion.rate, stop.stiffness, dissipation, stop.width);
  const StopForce<T> at_lower = joint_stop(below, T(-motion.rate), stop.stiffness, dissipation, stop.width);
  if (gradient) {
    append_local(view, load.pair, motion.position_q, at_upper.by_excess + at_lower.by_excess,
                 view.coordinate_moves_r(load.pair, load.element), &gradient->position);
    append_rate(view, load.pair, load.element, motion, at_upper.by_rate + at_lower.by_rate, gradient);
  }
  return at_upper.value - at_lower.value;
}

/// The part of stop_load() that takes energy from the motion, k delta (h - 1): the load less its elastic part. Appends its gradient.
template <class T>
T stop_dissipation(const StateView<T>& view, const JointLoad& load, const CoordinateMotion<T>& motion, OptionalGradient<T> gradient) {
  const auto before = mark(gradient);
  const T elastic = stop_load(view, load, motion, 0.0, gradient);
  if (gradient) gradient->scale_from(before, T(-1.0));
  return stop_load(view, load, motion, view.system.study().limits.dissipation, gradient) - elastic;
}

}  // namespace codesign

#endif  // MECHANISM_CODESIGN_ELEMENTS_JOINT_STOP_LOAD_H_
