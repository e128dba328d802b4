// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "mechanism/rigid_groups.h"

#include <gtest/gtest.h>

#include <string>

#include "reading/urdf/urdf_reader.h"

namespace codesign {
namespace {

/// A revolute joint and then `count` fixed joints, the last one first in the file.
RobotDescription chain(int count) {
  std::string content;
  for (int k = count + 1; k >= 1; --k) {
    const std::string name = "link" + std::to_string(k);
    content += "<link name='" + name +
               "'><inertial><mass value='0.1'/><inertia ixx='1' iyy='1' izz='1' ixy='0' ixz='0' "
               "iyz='0'/>" +
               "</inertial></link><joint name='joint" + std::to_string(k) + "' type='" +
               (k == 1 ? "continuous" : "fixed") + "'><parent link='link" + std::to_string(k - 1) +
               "'/><child link='" + name + "'/><origin xyz='0.01 0.02 0' rpy='0.1 0 0.2'/></joint>";
  }
  return read_urdf(
      {"chain.urdf", "<robot name='chain'>" + content + "<link name='link0'/></robot>"});
}

TEST(RigidGroups, ALongChainIsOneGroup) {
  const RobotDescription robot = chain(300);
  const RigidGroups groups(robot);
  for (std::size_t k = 0; k < robot.links.size(); ++k) {
    const std::string& base = robot.links[static_cast<std::size_t>(groups.link_base[k])].name;
    EXPECT_EQ(base, robot.links[k].name == "link0" ? "link0" : "link1");
  }
}

TEST(LinkPoses, AreThoseOfAWalkToTheBase) {
  const RobotDescription robot = chain(300);
  const RigidGroups groups(robot);
  LinkPoses<double> poses;
  poses.start(robot.links.size());
  for (int link = 0; link < static_cast<int>(robot.links.size()); ++link) {
    const Pose<double> walked =
        link_in_base<double>(robot, groups.link_base, groups.link_parent_joint, link, {});
    const Pose<double>& pose =
        poses.of(robot, groups.link_base, groups.link_parent_joint, link, {});
    const int depth = std::stoi(robot.links[static_cast<std::size_t>(link)].name.substr(4));
    if (depth <= 100) {
      EXPECT_EQ(pose.t, walked.t) << "to the last bit, " << depth;
    }
    EXPECT_LT((pose.t - walked.t).norm() + (pose.R - walked.R).norm(), 1e-12) << depth;
  }
}

}  // namespace
}  // namespace codesign
