// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_ELEMENTS_JOINT_LOAD_H_
#define MECHANISM_CODESIGN_ELEMENTS_JOINT_LOAD_H_

#include "elements/controllers.h"
#include "elements/gradient_rows.h"
#include "elements/joint_friction.h"
#include "elements/joint_stop_load.h"
#include "elements/state_view.h"
#include "elements/workspace.h"
#include "forces/brown_mcphee.h"
#include "forces/saturation.h"

namespace codesign {

// Loads along joint coordinates [N or N m], theory (13). A load L is positive against the coordinate, so that the rows of motion get
// + J^T L; an effort (of a controller, or a constant one) is positive along the coordinate and counts as -L. Functions with a `gradient`
// append to it if it is not null.

/// The sum of the study's constant efforts on a coordinate, theory (13g).
template <class T>
T constant_effort(const StateView<T>& view, const JointLoad& load) {
  T sum(0.0);
  for (int k : load.constant) sum += view.design.efforts[static_cast<std::size_t>(k)];
  return sum;
}

/// L of damping, torsion spring and `<dynamics friction>`, end of theory (13); `load` selects the ones that act.
/// @param motion with detail kGradient for a gradient, kAll if a spring acts too.
template <class T>
T passive_load(const StateView<T>& view, int pair, int element, const JointLoad& load, const CoordinateMotion<T>& motion,
               OptionalGradient<T> gradient) {
  constexpr double kDryTransitionVelocity = 1e-2;  // [m/s or rad/s]: URDF gives none
  const JointDynamicsConstants<T>& d =
      view.design.constants.pairs[static_cast<std::size_t>(pair)].dynamics[static_cast<std::size_t>(element)];
  T value(0.0), slope(0.0);
  if (load.passive) {
    slope = d.damping + d.spring_damping;
    value = slope * motion.rate;
    if (load.spring) value += d.stiffness * (view.coordinate_value(pair, element) - d.free_position);
  }
  if (load.constant_friction) {
    const FrictionCoefficient<T> S = brown_mcphee<T>(motion.rate, T(1.0), T(1.0), T(kDryTransitionVelocity));
    value += d.dry_friction * S.value;
    slope += d.dry_friction * S.slope;
  }
  if (gradient) {
    append_rate(view, pair, element, motion, slope, gradient);
    if (load.spring) append_local(view, pair, motion.position_q, d.stiffness, view.coordinate_moves_r(pair, element), &gradient->position);
  }
  return value;
}

/// The sum of the controllers' outputs on a coordinate, bounded by the actuator's limit (13c) if the study enforces `<limit effort>`.
template <class T>
T applied_effort(const StateView<T>& view, const JointLoad& load, OptionalGradient<T> gradient) {
  const auto before = mark(gradient);
  T demand(0.0);
  for (int controller : load.controllers) demand += drive_effort(view, controller, gradient);
  if (!load.saturated) return demand;
  const T& limit = view.design.constants.pairs[static_cast<std::size_t>(load.pair)].dynamics[static_cast<std::size_t>(load.element)].effort;
  const SaturatedEffort<T> applied = saturate(demand, limit);
  if (gradient) gradient->scale_from(before, applied.slope);
  return applied.value;
}

/// The whole load L along a coordinate: friction, damping, spring and stop minus constant and applied efforts.
/// @param motion with detail kGradient for a gradient, kAll if JointLoad::needs_position().
template <class T>
T joint_load(const StateView<T>& view, const JointLoad& load, const CoordinateMotion<T>& motion, OptionalGradient<T> gradient) {
  T value(0.0);
  if (load.reaction_friction) value += reaction_friction(view, load, motion, gradient, nullptr);
  if (load.passive || load.constant_friction) value += passive_load(view, load.pair, load.element, load, motion, gradient);
  if (load.stop) value += stop_load(view, load, motion, view.system.study().limits.dissipation, gradient);
  if (!load.constant.empty()) value -= constant_effort(view, load);
  if (load.controllers.empty()) return value;
  const auto before = mark(gradient);
  value -= applied_effort(view, load, gradient);
  if (gradient) gradient->scale_from(before, T(-1.0));
  return value;
}

/// The friction of a load, without its other parts. A copy of `load` would also copy its lists, which allocates memory.
inline JointLoad friction_part(const JointLoad& load) {
  JointLoad part;
  part.pair = load.pair;
  part.element = load.element;
  part.reaction_friction = load.reaction_friction;
  part.directional = load.directional;
  part.constant_friction = load.constant_friction;
  return part;
}

/// Adds J^T L to the rows of motion.
template <class T>
void load_residual(const StateView<T>& view, const JointLoad& load, VectorX<T>* G) {
  const CoordinateMotion<T>& motion = view.coordinate(load.pair, load.element, CoordinateDetail::kRate);
  const T value = joint_load(view, load, motion, nullptr);
  for (int local = 0; local < kLocalSize; ++local)
    if (const int c = view.column(load.pair, local); c >= 0) (*G)[c] += motion.J[local] * value;
}

/// Friction of a joint coordinate for observers: its rate, normal force and load L, of `<codesign:friction>` and `<dynamics friction>`.
template <class T>
FrictionState<T> joint_friction(const StateView<T>& view, int pair, int element) {
  const CoordinateMotion<T>& motion = view.coordinate(pair, element);
  FrictionState<T> state;
  for (const JointLoad& load : view.system.loads()) {
    if (load.pair != pair || load.element != element) continue;
    state.velocity = motion.rate;
    if (load.reaction_friction) reaction_friction(view, load, motion, nullptr, &state);
    if (load.constant_friction) {
      JointLoad dry = load;
      dry.passive = dry.spring = false;
      state.load += passive_load(view, pair, element, dry, motion, nullptr);
    }
  }
  return state;
}

/// The effort that controllers apply along a coordinate, within the actuator's limit; positive along the coordinate.
template <class T>
T joint_effort(const StateView<T>& view, int pair, int element) {
  T sum(0.0);
  for (const JointLoad& load : view.system.loads())
    if (load.pair == pair && load.element == element) sum += applied_effort(view, load, nullptr);
  return sum;
}

}  // namespace codesign

#endif  // MECHANISM_CODESIGN_ELEMENTS_JOINT_LOAD_H_
