// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "mechanism/rigid_groups.h"

namespace codesign {

RigidGroups::RigidGroups(const RobotDescription& robot) : link_parent_joint(robot.links.size(), -1), link_base(robot.links.size(), -1) {
  for (std::size_t k = 0; k < robot.joints.size(); ++k)
    if (!robot.joints[k].is_loop) link_parent_joint[static_cast<std::size_t>(robot.joints[k].child)] = static_cast<int>(k);
  for (std::size_t link = 0; link < robot.links.size(); ++link) {
    int base = static_cast<int>(link);
    for (int joint; (joint = link_parent_joint[static_cast<std::size_t>(base)]) >= 0;) {
      if (robot.joints[static_cast<std::size_t>(joint)].type != JointType::kFixed) break;
      base = robot.joints[static_cast<std::size_t>(joint)].parent;
    }
    link_base[link] = base;
  }
}

}  // namespace codesign
