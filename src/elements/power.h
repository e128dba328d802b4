// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "elements/contact.h"
#include "elements/joint_load.h"
#include "elements/link_load.h"
#include "elements/power_kind.h"
#include "elements/spring.h"
#include "elements/state_view.h"

namespace codesign {

// The powers [W] of theory (14c), positive where energy goes into the mechanism. A load L opposes the coordinate, so its power is -L
// theta'.

/// The part of a coordinate's load L that belongs to one kind of power.
template <class T>
T load_of_kind(const StateView<T>& view, PowerKind kind, const JointLoad& load, const T& rate) {
  switch (kind) {
    case PowerKind::kFriction:
      return joint_load(view, friction_part(load), rate);
    case PowerKind::kDamping: {
      JointLoad part;
      part.pair = load.pair;
      part.element = load.element;
      part.passive = load.passive;
      const T value = joint_load(view, part, rate);
      return load.stop ? T(value + stop_dissipation(view, load, rate)) : value;
    }
    case PowerKind::kActuator:
      return -applied_effort(view, load);
    case PowerKind::kLoad:
      break;
  }
  return -constant_effort(view, load);
}

/// The power of one kind along one joint coordinate; zero if no load of that kind acts there.
template <class T>
T load_power(const StateView<T>& view, PowerKind kind, const JointLoad& load) {
  const bool acts = kind == PowerKind::kFriction   ? load.reaction_friction || load.constant_friction
                    : kind == PowerKind::kDamping  ? load.passive || load.stop
                    : kind == PowerKind::kActuator ? !load.controllers.empty()
                                                   : !load.constant.empty();
  if (!acts) return T(0.0);
  const T rate = view.coordinate(load.pair, load.element, CoordinateDetail::kRate).rate;
  return -load_of_kind(view, kind, load, rate) * rate;
}

/// The power of one kind summed over the whole mechanism.
template <class T>
T total_power(const StateView<T>& view, PowerKind kind) {
  T sum(0.0);
  for (const JointLoad& load : view.system.loads()) sum += load_power(view, kind, load);
  if (kind == PowerKind::kFriction)
    for (int pair : view.system.contacts()) sum -= contact_at(view, pair).power();
  if (kind == PowerKind::kDamping)
    for (std::size_t k = 0; k < view.design.constants.springs.size(); ++k) sum += spring_power(view, k);
  if (kind == PowerKind::kLoad)
    for (std::size_t k = 0; k < view.system.link_loads().size(); ++k) sum += link_load_power(view, k);
  return sum;
}

/// The power of one kind in one joint: a pair and the index in its chain. Spring-dampers and loads on links belong to no joint.
template <class T>
T joint_power(const StateView<T>& view, PowerKind kind, int pair, int element) {
  const Pair& p = view.pair(pair);
  const auto elements = static_cast<int>(p.chain.size());
  T sum(0.0);
  // A cylindrical loop is one joint with two coordinates: the index of the second one is beyond the chain.
  for (const JointLoad& load : view.system.loads())
    if (load.pair == pair && (load.element == element || load.element >= elements)) sum += load_power(view, kind, load);
  const bool holds_friction = p.chain[to_index(element)].joint == p.friction_joint;
  if (kind == PowerKind::kFriction && holds_friction && slips_isotropically(p.kind)) sum -= contact_at(view, pair).power();
  return sum;
}

}  // namespace codesign
