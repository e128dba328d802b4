// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "mechanism/driven_tree.h"

#include <gtest/gtest.h>

#include "equations/arm.h"
#include "equations/compiled.h"

namespace codesign {
namespace {

/// The driven trees of a mechanism's joints, as names of bodies.
class Trees {
 public:
  explicit Trees(const std::string& urdf) : robot_(read_urdf({"test.urdf", urdf})), topology_(derive_topology(robot_)) {}

  DrivenTree of(const std::string& joint, bool accelerations) const {
    for (std::size_t k = 0; k < robot_.joints.size(); ++k)
      if (robot_.joints[k].name == joint)
        return driven_tree(topology_, topology_.joint_pair[k], accelerations, {"study.yaml", 7}, "controllers.servo.output");
    throw std::out_of_range(joint);
  }
  std::vector<std::string> names(const DrivenTree& tree) const {
    std::vector<std::string> names;
    for (const DrivenTree::Node& node : tree.nodes) names.push_back(topology_.bodies[static_cast<std::size_t>(node.body)].name);
    return names;
  }
  std::string fault(const std::string& joint, bool accelerations) const {
    try {
      of(joint, accelerations);
    } catch (const InputError& error) {
      EXPECT_EQ(error.fault().where.line, 7);
      EXPECT_EQ(error.fault().element, "controllers.servo.output");
      return error.fault().message;
    }
    return "";
  }

 private:
  RobotDescription robot_;
  Topology topology_;
};

using Names = std::vector<std::string>;

TEST(DrivenTree, GravityNeedsWhatTheJointMovesAndWhatCarriesIt) {
  const Trees trees(crane());
  const DrivenTree turn = trees.of("turn", false);
  EXPECT_EQ(trees.names(turn), (Names{"trolley", "mast", "boom", "gripper", "bob"}));
  EXPECT_EQ(turn.driven, 1);
  EXPECT_FALSE(turn.nodes[0].moved);
  EXPECT_EQ(turn.nodes[0].pair, -1);
  EXPECT_EQ(turn.nodes[3].parent, 2);
  EXPECT_TRUE(turn.nodes[2].slides);
  EXPECT_EQ(trees.of("travel", false).driven, 0) << "the ground needs no node";
}

TEST(DrivenTree, AccelerationsNeedEveryBodyFromTheGroundOn) {
  const Trees trees(double_pendulum());
  const DrivenTree elbow = trees.of("elbow", true);
  EXPECT_EQ(trees.names(elbow), (Names{"upper", "lower"}));
  EXPECT_EQ(elbow.driven, 1);
  EXPECT_FALSE(elbow.nodes[0].moved);
  EXPECT_GE(elbow.nodes[0].pair, 0);
}

TEST(DrivenTree, WhatTheLawsCannotWorkThroughIsRefused) {
  EXPECT_EQ(Trees(crane()).fault("wrist", true), "") << "the ball hangs elsewhere";
  EXPECT_NE(Trees(crane()).fault("turn", true).find("cannot work through this joint"), std::string::npos);
  EXPECT_NE(Trees(crane()).fault("ball_y", false).find("cannot work through this joint"), std::string::npos);
  EXPECT_NE(Trees(four_bar()).fault("left_hinge", false).find("a loop connects"), std::string::npos);
}

TEST(DrivenTree, ALoopBelowTheJointDoesNotMatter) {
  const std::string loop =
      "<loop name='link' type='codesign:distance'><codesign:length value='0.5'/><predecessor link='boom'/><successor "
      "link='gripper'/></loop>";
  const Trees trees(crane(loop));
  EXPECT_EQ(trees.fault("reach", false), "");
  EXPECT_NE(trees.fault("wrist", false), "");
}

}  // namespace
}  // namespace codesign
