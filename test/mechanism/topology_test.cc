// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "mechanism/topology.h"

#include <gtest/gtest.h>

#include "reading/urdf/urdf_reader.h"

namespace codesign {
namespace {

std::string heavy(const std::string& name) {
  return "<link name='" + name +
         "'><inertial><mass value='1'/><inertia ixx='1' ixy='0' ixz='0' iyy='1' iyz='0' "
         "izz='1'/></inertial></link>";
}

std::string light(const std::string& name) { return "<link name='" + name + "'/>"; }

std::string joint(const std::string& name, const std::string& type, const std::string& parent,
                  const std::string& child, const std::string& axis,
                  const std::string& xyz = "0 0 0") {
  return "<joint name='" + name + "' type='" + type + "'><parent link='" + parent +
         "'/><child link='" + child + "'/><origin xyz='" + xyz + "'/><axis xyz='" + axis +
         "'/><limit lower='0' upper='0' effort='1' velocity='1'/></joint>";
}

Topology topology(const std::string& content) {
  return derive_topology(
      read_urdf({"t.urdf", "<robot name='t' xmlns:codesign='urn:t'><link name='ground'/>" +
                               content + "</robot>"}));
}

PairKind only_kind(const std::string& content) {
  const Topology t = topology(content);
  EXPECT_EQ(t.pairs.size(), 1U);
  return t.pairs.at(0).kind;
}

TEST(Topology, FoldsMasslessChains) {
  const std::string two = light("m") + heavy("b"), three = light("m") + light("n") + heavy("b");
  EXPECT_EQ(only_kind(two + joint("1", "continuous", "ground", "m", "1 0 0") +
                      joint("2", "continuous", "m", "b", "0 1 0")),
            PairKind::kUniversal);
  EXPECT_EQ(only_kind(two + joint("1", "prismatic", "ground", "m", "1 0 0") +
                      joint("2", "prismatic", "m", "b", "0 1 0")),
            PairKind::kTable);
  EXPECT_EQ(only_kind(two + joint("1", "continuous", "ground", "m", "0 0 1") +
                      joint("2", "prismatic", "m", "b", "0 0 1", "0 0 0.3")),
            PairKind::kCylindrical);
  EXPECT_EQ(only_kind(three + joint("1", "continuous", "ground", "m", "1 0 0") +
                      joint("2", "continuous", "m", "n", "0 1 0") +
                      joint("3", "continuous", "n", "b", "0 0 1")),
            PairKind::kSpherical);
  EXPECT_EQ(only_kind(three + joint("1", "prismatic", "ground", "m", "1 0 0") +
                      joint("2", "prismatic", "m", "n", "0 1 0") +
                      joint("3", "continuous", "n", "b", "0 0 1")),
            PairKind::kPlanar);
}

TEST(Topology, WhatFoldsIntoNoJointIsABodyWithoutMass) {
  // A massless link between two parallel hinges at a distance.
  const Topology rod =
      topology(light("m") + heavy("b") + joint("1", "continuous", "ground", "m", "0 1 0") +
               joint("2", "continuous", "m", "b", "0 1 0", "1 0 0"));
  ASSERT_EQ(rod.bodies.size(), 2U);
  EXPECT_EQ(rod.bodies[0].name, "m");
  EXPECT_EQ(rod.joint_pair, (std::vector<int>{0, 1}));
  // A massless link that carries two bodies.
  const Topology fork = topology(
      light("m") + heavy("b") + heavy("c") + joint("1", "continuous", "ground", "m", "1 0 0") +
      joint("2", "continuous", "m", "b", "0 1 0") + joint("3", "continuous", "m", "c", "0 1 0"));
  EXPECT_EQ(fork.bodies.size(), 3U);
  EXPECT_EQ(fork.joint_pair, (std::vector<int>{0, 1, 2}));
}

TEST(Topology, FrictionOfAFoldedChainIsCheckedAsTheJointThatItFoldsInto) {
  const auto with_friction = [](std::string text, const std::string& attributes) {
    const std::size_t end = text.find("</joint>");
    return text.insert(end,
                       "<codesign:friction mu_static='0.4' mu_dynamic='0.3' " + attributes + "/>");
  };
  const std::string table = light("m") + heavy("b") +
                            joint("1", "prismatic", "ground", "m", "1 0 0") +
                            joint("2", "prismatic", "m", "b", "0 1 0");
  const Topology t = topology(with_friction(table, ""));
  EXPECT_EQ(t.pairs.at(0).friction_joint, 0);
  const std::string ball =
      light("m") + light("n") + heavy("b") + joint("1", "continuous", "ground", "m", "1 0 0") +
      joint("2", "continuous", "m", "n", "0 1 0") + joint("3", "continuous", "n", "b", "0 0 1");
  EXPECT_NO_THROW(topology(with_friction(ball, "pin_radius='0.01'")));
  EXPECT_THROW(topology(with_friction(ball, "joint_length='0.01'")), InputError);
  const std::string universal = light("m") + heavy("b") +
                                joint("1", "continuous", "ground", "m", "1 0 0") +
                                joint("2", "continuous", "m", "b", "0 1 0");
  EXPECT_THROW(topology(with_friction(universal, "joint_length='0.01' pin_radius='0.01'")),
               InputError);
}

TEST(Topology, MergesFixedLinksAndLeavesSensorFramesOut) {
  const Topology t = topology(heavy("a") + heavy("b") + light("camera") + light("finger") +
                              joint("1", "continuous", "ground", "a", "0 1 0") +
                              joint("2", "fixed", "a", "b", "1 0 0", "0 0 1") +
                              joint("3", "fixed", "b", "camera", "1 0 0") +
                              joint("4", "continuous", "b", "finger", "1 0 0"));
  ASSERT_EQ(t.bodies.size(), 1U);
  EXPECT_EQ(t.bodies[0].name, "a");
  EXPECT_EQ(t.bodies[0].links.size(), 3U);
  EXPECT_EQ(t.pairs.size(), 1U);
  EXPECT_EQ(t.joint_pair, (std::vector<int>{0, -1, -1, -1}));
}

}  // namespace
}  // namespace codesign
