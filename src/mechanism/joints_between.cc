// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "mechanism/joints_between.h"

#include <algorithm>

#include "math/to_index.h"

namespace codesign {
namespace {}  // namespace

std::vector<int> links_above(const RobotDescription& robot, const std::vector<int>& link_parent_joint, int link) {
  std::vector<int> links = {link};
  for (int joint; (joint = link_parent_joint[to_index(links.back())]) >= 0;) links.push_back(robot.joints[to_index(joint)].parent);
  return links;
}

std::vector<int> joints_between(const RobotDescription& robot, const std::vector<int>& link_parent_joint, int predecessor, int successor) {
  const std::vector<int> above = links_above(robot, link_parent_joint, predecessor);
  const std::vector<int> below = links_above(robot, link_parent_joint, successor);
  const int ancestor = *std::find_first_of(below.begin(), below.end(), above.begin(), above.end());
  std::vector<int> joints;
  for (int end : {predecessor, successor}) {
    for (int link = end; link != ancestor;) {
      const int joint = link_parent_joint[to_index(link)];
      if (robot.joints[to_index(joint)].type != JointType::kFixed) joints.push_back(joint);
      link = robot.joints[to_index(joint)].parent;
    }
  }
  return joints;
}

}  // namespace codesign
