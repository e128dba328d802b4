// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "mechanism/fixed_base.h"

#include <vector>

#include "math/arrays.h"
#include "mechanism/constants.h"
#include "mechanism/rigid_groups.h"

namespace codesign {

double mass_of_base(const RobotDescription& robot) {
  const RigidGroups groups(robot);
  std::vector<int> links;
  for (std::size_t link = 0; link < robot.links.size(); ++link)
    if (groups.link_base[link] == groups.link_base[to_index(robot.root)])
      links.push_back(static_cast<int>(link));
  MassWorkspace<double> workspace;
  workspace.poses.start(robot.links.size());
  return merged_mass(robot, groups.link_base, groups.link_parent_joint, links,
                     default_values(robot), &workspace)
      .mass;
}

bool is_on_ground(const RobotDescription& robot) {
  const LinkDescription& root = robot.links[to_index(robot.root)];
  if (root.inertial) return false;
  for (const char* name : {"world", "ground", "map", "odom"})
    if (root.name == name) return true;
  return false;
}

}  // namespace codesign
