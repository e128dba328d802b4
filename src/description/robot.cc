// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "description/robot.h"

#include "description/parameter_switches.h"

namespace codesign {

const Laws& standard_laws() {
  static const Laws laws{friction_laws(), joint_laws(),   control_laws(),
                         losses(),        contact_laws(), contact_shapes()};
  return laws;
}

PairKind kind_of(const JointDescription& joint) {
  const PairKind kind = pair_of(joint.law());
  return joint.in_plane ? PairKind(*kind->in_plane) : kind;
}

std::optional<FrictionModel> find_friction(const Laws& laws, const std::string& name) {
  for (const FrictionModel& law : laws.friction)
    if (name == law->name) return law;
  return std::nullopt;
}

RobotDescription::RobotDescription() = default;
RobotDescription::RobotDescription(const RobotDescription&) = default;
RobotDescription::RobotDescription(RobotDescription&&) noexcept = default;
RobotDescription& RobotDescription::operator=(const RobotDescription&) = default;
RobotDescription& RobotDescription::operator=(RobotDescription&&) noexcept = default;
RobotDescription::~RobotDescription() = default;

int joint_named(const RobotDescription& robot, const std::string& name) {
  for (std::size_t k = 0; k < robot.joints.size(); ++k)
    if (robot.joints[k].name == name) return static_cast<int>(k);
  return -1;
}

}  // namespace codesign
