// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_EQUATIONS_EQUATIONS_LIMITS_H_
#define MECHANISM_CODESIGN_EQUATIONS_EQUATIONS_LIMITS_H_

#include "equations/equations.h"
#include "forces/joint_stop.h"
#include "forces/saturation.h"

namespace codesign {

// URDF's `<limit>` where the study enforces it, theory (13c), (13d).

template <class T>
T Equations<T>::applied_effort(const JointLoad& load, SparseGradient<T>* gradient) {
  const auto before = mark(gradient);
  T demand(0.0);
  for (int controller : load.controllers) demand += controller_output(controller, gradient);
  if (!load.saturated) return demand;
  const T& limit = constants_.pairs[static_cast<std::size_t>(load.pair)].dynamics[static_cast<std::size_t>(load.element)].effort;
  const SaturatedEffort<T> applied = saturate(demand, limit);
  if (gradient) gradient->scale_from(before, applied.slope);
  return applied.value;
}

template <class T>
T Equations<T>::stop_load(const JointLoad& load, const CoordinateMotion<T>& motion, double dissipation, SparseGradient<T>* gradient) const {
  const JointDynamicsConstants<T>& d =
      constants_.pairs[static_cast<std::size_t>(load.pair)].dynamics[static_cast<std::size_t>(load.element)];
  const LimitOptions& stop = system_.study().limits;
  const T position = coordinate_value(load.pair, load.element), below = d.lower - position, above = position - d.upper;
  const StopForce<T> at_upper = joint_stop(above, motion.rate, stop.stiffness, dissipation, stop.width);
  const StopForce<T> at_lower = joint_stop(below, T(-motion.rate), stop.stiffness, dissipation, stop.width);
  if (gradient) {
    append_local(load.pair, motion.position_q, at_upper.by_excess + at_lower.by_excess, coordinate_moves_r(load.pair, load.element),
                 &gradient->position);
    append_rate(load.pair, load.element, motion, at_upper.by_rate + at_lower.by_rate, gradient);
  }
  return at_upper.value - at_lower.value;
}

template <class T>
T Equations<T>::stop_dissipation(const JointLoad& load, const CoordinateMotion<T>& motion, SparseGradient<T>* gradient) const {
  const auto before = mark(gradient);
  const T elastic = stop_load(load, motion, 0.0, gradient);
  if (gradient) gradient->scale_from(before, T(-1.0));
  return stop_load(load, motion, system_.study().limits.dissipation, gradient) - elastic;
}

}  // namespace codesign

#endif  // MECHANISM_CODESIGN_EQUATIONS_EQUATIONS_LIMITS_H_
