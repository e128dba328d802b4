// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "description/signal_table.h"

#include <algorithm>

#include "description/robot.h"
#include "joints/joint_law.h"

namespace codesign {
namespace {

template <class Condition>
const SignalFacts* find_facts(Condition&& condition) {
  const auto& facts = signal_table::kFacts;
  const auto found = std::find_if(facts.begin(), facts.end(), condition);
  return found == facts.end() ? nullptr : &*found;
}

}  // namespace

bool has_coordinate(const JointDescription& joint) { return joint.has_one_coordinate(); }
bool has_actuator(const JointDescription& joint) { return joint.actuator.has_value(); }
bool has_winding(const JointDescription& joint) { return joint.has_winding(); }
bool has_elastic_gear(const JointDescription& joint) { return joint.has_elastic_gear(); }
bool has_gear_loss(const JointDescription& joint) { return joint.actuator && joint.actuator->gear; }
bool has_gear_torque(const JointDescription& joint) { return joint.has_gear_torque(); }
bool has_friction(const JointDescription& joint) {
  return joint.friction.has_value() || !joint.dry_friction.is_zero() || has_gear_loss(joint);
}
bool has_normal_force(const JointDescription& joint) {
  return joint.friction ? !joint.friction->is_direct : !joint.dry_friction.is_zero();
}
bool is_movable(const JointDescription& joint) { return !joint.is_fixed() || joint.is_loop; }

const SignalFacts* find_quantity(SignalOwner owner, const std::string& quantity) {
  return find_facts([&](const SignalFacts& facts) {
    return facts.owner == owner && !quantity.empty() && facts.quantity == quantity;
  });
}

bool is_quantity(const std::string& quantity) {
  return find_facts([&](const SignalFacts& facts) {
           return !quantity.empty() && facts.quantity == quantity;
         }) != nullptr;
}

}  // namespace codesign
