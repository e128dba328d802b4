// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "mechanism/rigid_groups.h"

#include "math/arrays.h"

namespace codesign {

RigidGroups::RigidGroups(const RobotDescription& robot)
    : link_parent_joint(robot.links.size(), -1), link_base(robot.links.size(), -1) {
  for (std::size_t k = 0; k < robot.joints.size(); ++k)
    if (!robot.joints[k].is_loop)
      link_parent_joint[to_index(robot.joints[k].child)] = static_cast<int>(k);
  // Each link is passed once: a walk towards the root ends where the base is known.
  std::vector<std::size_t> walked;
  for (std::size_t link = 0; link < robot.links.size(); ++link) {
    std::size_t at = link;
    for (walked.clear(); link_base[at] < 0;
         at = to_index(robot.joints[to_index(link_parent_joint[at])].parent)) {
      walked.push_back(at);
      const int joint = link_parent_joint[at];
      if (joint >= 0 && robot.joints[to_index(joint)].is_fixed()) continue;
      link_base[at] = static_cast<int>(at);
      break;
    }
    for (const std::size_t passed : walked) link_base[passed] = link_base[at];
  }
}

}  // namespace codesign
