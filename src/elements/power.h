// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_ELEMENTS_POWER_H_
#define MECHANISM_CODESIGN_ELEMENTS_POWER_H_

#include "elements/contact.h"
#include "elements/gradient_rows.h"
#include "elements/joint_load.h"
#include "elements/link_load.h"
#include "elements/power_kind.h"
#include "elements/spring.h"
#include "elements/state_view.h"

namespace codesign {

// The powers [W] of theory (14c), positive where energy goes into the mechanism. A load L opposes the coordinate, so its power is -L
// theta'. Each function appends its gradient if `gradient` is not null.

/// The part of a coordinate's load L that belongs to one kind of power.
template <class T>
T load_of_kind(const StateView<T>& view, PowerKind kind, const JointLoad& load, const CoordinateMotion<T>& motion,
               OptionalGradient<T> gradient) {
  switch (kind) {
    case PowerKind::kFriction:
      return joint_load(view, friction_part(load), motion, gradient);
    case PowerKind::kDamping: {
      JointLoad part;
      part.pair = load.pair;
      part.element = load.element;
      part.passive = load.passive;
      T value = joint_load(view, part, motion, gradient);
      return load.stop ? T(value + stop_dissipation(view, load, motion, gradient)) : value;
    }
    case PowerKind::kActuator: {
      const auto before = mark(gradient);
      const T value = applied_effort(view, load, gradient);
      if (gradient) gradient->scale_from(before, T(-1.0));
      return -value;
    }
    case PowerKind::kLoad:
      break;
  }
  return -constant_effort(view, load);
}

/// The power of one kind along one joint coordinate; zero if no load of that kind acts there.
template <class T>
T load_power(const StateView<T>& view, PowerKind kind, const JointLoad& load, OptionalGradient<T> gradient) {
  const bool acts = kind == PowerKind::kFriction   ? load.reaction_friction || load.constant_friction
                    : kind == PowerKind::kDamping  ? load.passive || load.stop
                    : kind == PowerKind::kActuator ? !load.controllers.empty()
                                                   : !load.constant.empty();
  if (!acts) return T(0.0);
  const CoordinateDetail detail = !gradient                                              ? CoordinateDetail::kRate
                                  : kind == PowerKind::kDamping && load.needs_position() ? CoordinateDetail::kAll
                                                                                         : CoordinateDetail::kGradient;
  // A copy, since a controller may request more detail of this coordinate, which overwrites the referenced object.
  const CoordinateMotion<T> motion = view.coordinate(load.pair, load.element, detail);
  const auto before = mark(gradient);
  const T value = load_of_kind(view, kind, load, motion, gradient);
  if (gradient) {
    gradient->scale_from(before, -motion.rate);
    append_rate(view, load.pair, load.element, motion, -value, gradient);
  }
  return -value * motion.rate;
}

/// The power of isotropic friction in a pair, theory (13a).
template <class T>
T contact_power(const StateView<T>& view, int pair, OptionalGradient<T> gradient) {
  const ContactFriction<T> c = contact_at(view, pair, gradient ? CoordinateDetail::kGradient : CoordinateDetail::kRate);
  for (std::size_t k = 0; gradient && k < c.size; ++k) {
    append_contact_load(view, pair, c, k, T(-c.motion[k].rate), gradient);
    append_slip_rate(view, pair, c, k, T(-c.load[static_cast<Eigen::Index>(k)]), gradient);
  }
  return -c.power();
}

/// The power of one kind summed over the whole mechanism.
template <class T>
T total_power(const StateView<T>& view, PowerKind kind, OptionalGradient<T> gradient) {
  T sum(0.0);
  for (const JointLoad& load : view.system.loads()) sum += load_power(view, kind, load, gradient);
  if (kind == PowerKind::kFriction)
    for (int pair : view.system.contacts()) sum += contact_power(view, pair, gradient);
  if (kind == PowerKind::kDamping)
    for (std::size_t k = 0; k < view.design.constants.springs.size(); ++k) sum += spring_power(view, k, gradient);
  if (kind == PowerKind::kLoad)
    for (std::size_t k = 0; k < view.system.link_loads().size(); ++k) sum += link_load_power(view, k, gradient);
  return sum;
}

/// The power of one kind in one joint: a pair and the index in its chain. Spring-dampers and loads on links belong to no joint.
template <class T>
T joint_power(const StateView<T>& view, PowerKind kind, int pair, int element, OptionalGradient<T> gradient) {
  const Pair& p = view.system.topology().pairs[static_cast<std::size_t>(pair)];
  const auto elements = static_cast<int>(p.chain.size());
  T sum(0.0);
  // A cylindrical loop is one joint with two coordinates: the index of the second one is beyond the chain.
  for (const JointLoad& load : view.system.loads())
    if (load.pair == pair && (load.element == element || load.element >= elements)) sum += load_power(view, kind, load, gradient);
  const bool holds_friction = p.chain[static_cast<std::size_t>(element)].joint == p.friction_joint;
  if (kind == PowerKind::kFriction && holds_friction && slips_isotropically(p.kind)) sum += contact_power(view, pair, gradient);
  return sum;
}

}  // namespace codesign

#endif  // MECHANISM_CODESIGN_ELEMENTS_POWER_H_
