// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include "equations/arm.h"
#include "equations/compiled.h"
#include "mechanism/constants.h"
#include "mechanism/coupling.h"
#include "mechanism/topology.h"
#include "reading/urdf/urdf_fixture.h"

namespace codesign {
namespace {

/// ground - shoulder - upper - elbow - lower, and ground - motor - rotor.
std::string coupled_arm(const std::string& more, const std::string& elbow = "") {
  return kGround + link_with("upper") + link_with("lower") + link_with("rotor") +
         joint_with("shoulder", "continuous", "ground", "upper") +
         joint_with("elbow", "continuous", "upper", "lower", elbow) +
         joint_with("motor", "continuous", "ground", "rotor") + "\n" + more;
}

std::string coupling(const std::string& predecessor, const std::string& successor) {
  return "<coupling name=\"belt\"><predecessor link=\"" + predecessor + "\"/><successor link=\"" +
         successor + "\"/><ratio value=\"0.4\" codesign:value=\"${2*length}\"/></coupling>";
}

std::string coupling_fault(const SourceText& urdf) {
  try {
    derive_topology(read_urdf(urdf));
  } catch (const InputError& error) {
    return error.what();
  }
  ADD_FAILURE() << "accepted";
  return "";
}

TEST(Coupling, AMimicFollowsWithItsMultiplierAndOffset) {
  const RobotDescription robot =
      read_urdf(robot_text(coupled_arm("",
                                       "<mimic joint=\"shoulder\" multiplier=\"-0.2\" "
                                       "codesign:multiplier=\"${-length}\" offset=\"0.3\"/>")));
  const Topology topology = derive_topology(robot);
  ASSERT_EQ(topology.couplings.size(), 1U);
  const Coupling& c = topology.couplings[0];
  EXPECT_EQ(c.element(), "<joint name=\"elbow\"> <mimic>");
  ASSERT_EQ(c.terms.size(), 2U);
  EXPECT_EQ(robot.joints[static_cast<std::size_t>(c.terms[0].joint)].name, "elbow");
  EXPECT_EQ(robot.joints[static_cast<std::size_t>(c.terms[1].joint)].name, "shoulder");
  const auto constants = evaluate_constants<double>(robot, topology, {0.25}).couplings.at(0);
  EXPECT_EQ(constants.coefficients, (std::vector<double>{1.0, 0.25}));
  EXPECT_EQ(constants.offset, 0.3);
}

TEST(Coupling, SumsTheJointsFromTheNearestCommonAncestor) {
  const RobotDescription robot = read_urdf(robot_text(coupled_arm(coupling("lower", "rotor"))));
  const Topology topology = derive_topology(robot);
  ASSERT_EQ(topology.couplings.size(), 1U);
  std::vector<std::string> joints;
  for (const CouplingTerm& term : topology.couplings[0].terms)
    joints.push_back(robot.joints[static_cast<std::size_t>(term.joint)].name);
  EXPECT_EQ(joints, (std::vector<std::string>{"motor", "elbow", "shoulder"}));
  // theta_motor - ratio (theta_elbow + theta_shoulder) = 0
  EXPECT_EQ(evaluate_constants<double>(robot, topology, {0.3}).couplings.at(0).coefficients,
            (std::vector<double>{1.0, -0.6, -0.6}));
}

TEST(Coupling, OfALinkAndOneBelowItTakesTheJointsBetween) {
  const RobotDescription robot = read_urdf(robot_text(coupled_arm(coupling("upper", "lower"))));
  const Topology topology = derive_topology(robot);
  ASSERT_EQ(topology.couplings.size(), 1U);
  ASSERT_EQ(topology.couplings[0].terms.size(), 1U)
      << "the predecessor is the nearest common ancestor";
  EXPECT_EQ(robot.joints[static_cast<std::size_t>(topology.couplings[0].terms[0].joint)].name,
            "elbow");
}

TEST(Coupling, WhatCannotBeCoupledIsNamedWithItsPlace) {
  EXPECT_NE(coupling_fault(robot_text(coupled_arm(coupling("lower", "upper"))))
                .find("test.urdf:3: <coupling name=\"belt\">: no joint moves the successor"),
            std::string::npos);
  const std::string floating = link_with("base") + joint_with("free", "floating", "ground", "base");
  EXPECT_NE(coupling_fault(robot_text(coupled_arm(coupling("upper", "base") + floating)))
                .find("more than one coordinate (value: free"),
            std::string::npos);
}

TEST(Coupling, ALinkWithoutMassThatIsCoupledIsABody) {
  const std::string frame =
      link_with("frame", "") + joint_with("sensor", "continuous", "lower", "frame");
  const RobotDescription robot =
      read_urdf(robot_text(coupled_arm(coupling("upper", "frame") + frame)));
  const Topology topology = derive_topology(robot);
  EXPECT_EQ(topology.couplings.at(0).terms.size(), 2U);
  EXPECT_EQ(topology.bodies.back().name, "frame");
}

TEST(Coupling, WhatFollowsAJointWithoutMassKeepsIt) {
  // The driving finger has no inertial, the one that mimics it has; the coupling needs both
  // coordinates.
  const std::string fingers = link_with("driver", "") +
                              joint_with("drive", "continuous", "lower", "driver") +
                              link_with("follower") +
                              joint_with("follow", "continuous", "lower", "follower",
                                         "<mimic joint=\"drive\" multiplier=\"-1\"/>");
  const Topology topology = derive_topology(read_urdf(robot_text(coupled_arm(fingers))));
  ASSERT_EQ(topology.couplings.size(), 1U);
  EXPECT_EQ(topology.couplings[0].terms.size(), 2U);
  const std::string light =
      link_with("driver", "") + joint_with("drive", "continuous", "lower", "driver") +
      link_with("follower", "") +
      joint_with("follow", "continuous", "lower", "follower", "<mimic joint=\"drive\"/>");
  EXPECT_TRUE(derive_topology(read_urdf(robot_text(coupled_arm(light)))).couplings.empty())
      << "nobody has mass";
}

TEST(Coupling, AMimicOfAFixedJointStandsAtItsOffset) {
  const std::string more =
      link_with("plate") + joint_with("weld", "fixed", "lower", "plate") + link_with("tip") +
      joint_with("wrist", "continuous", "lower", "tip", "<mimic joint=\"weld\" offset=\"0.4\"/>");
  const RobotDescription robot = read_urdf(robot_text(coupled_arm(more)));
  const Topology topology = derive_topology(robot);
  ASSERT_EQ(topology.couplings.size(), 1U);
  EXPECT_EQ(topology.couplings[0].terms.size(), 1U);
  EXPECT_EQ(evaluate_constants<double>(robot, topology, {0.2}).couplings.at(0).offset, 0.4);
}

TEST(Coupling, AMimicThatMovesNoMassNeedsNoRow) {
  const std::string frame =
      link_with("frame", "") +
      joint_with("sensor", "continuous", "lower", "frame", "<mimic joint=\"elbow\"/>");
  EXPECT_TRUE(derive_topology(read_urdf(robot_text(coupled_arm(frame)))).couplings.empty());
}

/// The driven trees of a mechanism's joints, as names of bodies.
class Trees {
 public:
  explicit Trees(const std::string& urdf)
      : robot_(read_urdf({"test.urdf", urdf})), topology_(derive_topology(robot_)) {}

  DrivenTree of(const std::string& joint, bool accelerations) const {
    for (std::size_t k = 0; k < robot_.joints.size(); ++k)
      if (robot_.joints[k].name == joint)
        return driven_tree(topology_, topology_.joint_pair[k], accelerations, {"study.yaml", 7},
                           "controllers.servo.output");
    throw std::out_of_range(joint);
  }
  std::vector<std::string> names(const DrivenTree& tree) const {
    std::vector<std::string> names;
    for (const DrivenTree::Node& node : tree.nodes)
      names.push_back(topology_.bodies[static_cast<std::size_t>(node.body)].name);
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
  EXPECT_NE(Trees(crane()).fault("turn", true).find("cannot work through this joint"),
            std::string::npos);
  EXPECT_NE(Trees(crane()).fault("ball_y", false).find("cannot work through this joint"),
            std::string::npos);
  EXPECT_NE(Trees(four_bar()).fault("left_hinge", false).find("a loop connects"),
            std::string::npos);
}

TEST(DrivenTree, ALoopBelowTheJointDoesNotMatter) {
  const std::string loop =
      "<loop name='link' type='codesign:distance'><codesign:length value='0.5'/><predecessor "
      "link='boom'/><successor "
      "link='gripper'/></loop>";
  const Trees trees(crane(loop));
  EXPECT_EQ(trees.fault("reach", false), "");
  EXPECT_NE(trees.fault("wrist", false), "");
}

TEST(Coupling, TheJointsThatLetAnotherOnePlayAreNoPartOfIt) {
  const std::string play =
      "<codesign:clearance radial=\"1e-4\" radius=\"0.01\" stiffness=\"1e8\"/>";
  for (const char* successor : {"rotor", "lower"}) {
    const bool is_below = std::string(successor) == "rotor";
    const RobotDescription robot =
        read_urdf(robot_text(coupled_arm(coupling(is_below ? "lower" : "rotor", successor), play)));
    const Topology topology = derive_topology(robot);
    ASSERT_EQ(topology.couplings.size(), 1U);
    std::vector<std::string> joints;
    for (const CouplingTerm& term : topology.couplings[0].terms)
      joints.push_back(robot.joints[static_cast<std::size_t>(term.joint)].name);
    EXPECT_EQ(joints, is_below ? (std::vector<std::string>{"motor", "elbow", "shoulder"})
                               : (std::vector<std::string>{"elbow", "shoulder", "motor"}));
  }
}

}  // namespace

}  // namespace codesign
