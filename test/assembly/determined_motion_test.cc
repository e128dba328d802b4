// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "assembly/determined_motion.h"

#include <gtest/gtest.h>

#include <cmath>

#include "mechanism_codesign/simulation.h"
#include "problem/load_problem.h"

namespace codesign {
namespace {

std::string link(const std::string& name, const std::string& mass, const std::string& inertia, const std::string& centre) {
  const std::string zero = "' ixy='0' ixz='0' iyz='0' iyy='";
  return "<link name='" + name + "'><inertial><origin xyz='" + centre + "'/><mass value='" + mass + "'/><inertia ixx='" + inertia + zero +
         inertia + "' izz='" + inertia + "'/></inertial></link>\n";
}

std::string joint(const std::string& name, const std::string& parent, const std::string& child, const std::string& xyz,
                  const std::string& axis = "0 1 0", const std::string& more = "") {
  return "<joint name='" + name + "' type='continuous'><parent link='" + parent + "'/><child link='" + child + "'/><origin xyz='" + xyz +
         "'/><axis xyz='" + axis + "'/>" + more + "</joint>\n";
}

Problem load(const std::string& content) {
  return load_mechanism({"t.urdf", "<robot name='t'>\n<link name='ground'/>\n" + content + "</robot>"}, {});
}

std::string fault_of(const std::string& content) {
  try {
    load(content);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

/// Acceleration of a joint at rest at the start.
double acceleration(const std::string& content, const std::string& name) {
  const Problem problem = load(content);
  Simulation simulation(problem.system(), problem.parameters(), {parse_signal(name + "/acceleration", {}, "")});
  EXPECT_TRUE(simulation.start().ok());
  Frame frame;
  simulation.sample(0.0, &frame);
  return frame.signals.at(0);
}

constexpr double kGravity = 9.81;

TEST(DeterminedMotion, APointOnAnArmIsAPendulum) {
  EXPECT_NEAR(acceleration(link("a", "2", "0", "0.5 0 0") + joint("j", "ground", "a", "0 0 0"), "j"), kGravity / 0.5, 1e-9);
}

TEST(DeterminedMotion, APointOnItsAxisIsNot) {
  const std::string fault = fault_of(link("a", "2", "0", "0 0.3 0") + joint("j", "ground", "a", "0 0 0"));
  EXPECT_NE(fault.find("t.urdf:3: <link name=\"a\">: nothing with inertia resists the link turning about the axis (0 1 0) of joint 'j'"),
            std::string::npos)
      << fault;
}

TEST(DeterminedMotion, ARotorWithoutMass) {
  EXPECT_EQ(acceleration(link("a", "0", "0.1", "0.5 0 0") + joint("j", "ground", "a", "0 0 0"), "j"), 0.0);
  // The massless link is on an arm and can turn relative to it. Acceleration of the arm: m g l / (m l^2 + J).
  const std::string arm = link("a", "2", "0", "0.5 0 0") + joint("j", "ground", "a", "0 0 0");
  EXPECT_NEAR(acceleration(arm + link("r", "0", "0.1", "0 0 0") + joint("k", "a", "r", "0.5 0 0"), "j"), kGravity / 0.5, 1e-9);
  EXPECT_NEAR(acceleration(arm + link("r", "0", "0.1", "0 0 0") + joint("k", "a", "r", "0.5 0 0", "1 0 0"), "j"),
              2.0 * kGravity * 0.5 / (2.0 * 0.25 + 0.1), 1e-9);
}

TEST(DeterminedMotion, AMasslessLinkBetweenSkewHingesIsCarried) {
  const std::string chain = "<link name='m'/>" + joint("j", "ground", "m", "0 0 0") + link("a", "2", "0.1", "0.3 0 0.2") +
                            joint("k", "m", "a", "0.4 0 0", "0 0 1");
  EXPECT_EQ(fault_of(chain), "");
  // About j alone, k held by symmetry: the centre lies in the x-z plane 0.7 and 0.2 away.
  EXPECT_NEAR(acceleration(chain, "j"), 2.0 * kGravity * 0.7 / (2.0 * (0.49 + 0.04) + 0.1), 1e-9);
}

TEST(DeterminedMotion, APointBehindTwoStretchedMasslessLinks) {
  const std::string fault =
      fault_of("<link name='m'/>" + joint("j", "ground", "m", "0 0 0") + link("a", "2", "0", "0.3 0 0") + joint("k", "m", "a", "0.4 0 0"));
  EXPECT_NE(fault.find("not determined at the start"), std::string::npos);
  EXPECT_NE(fault.find("j: "), std::string::npos);
  EXPECT_NE(fault.find("k: 1"), std::string::npos) << fault;
}

TEST(DeterminedMotion, ACouplingCarriesWhatHasNoMass) {
  const std::string arm = link("a", "2", "0", "0.5 0 0") + joint("j", "ground", "a", "0 0 0");
  const std::string finger = "<link name='f'/>" + joint("lead", "ground", "f", "0 0 0");
  const std::string follower =
      link("a", "2", "0", "0.5 0 0") + joint("j", "ground", "a", "0 0 0", "0 1 0", "<mimic joint='lead' multiplier='-1'/>");
  EXPECT_EQ(fault_of(finger + follower), "");
  EXPECT_NEAR(acceleration(finger + follower, "lead"), -kGravity / 0.5, 1e-9);
}

TEST(DeterminedMotion, ANegativeMassOnAHeavyArmIsWhatItSays) {
  const std::string arm = link("a", "2", "0.1", "0.5 0 0") + joint("j", "ground", "a", "0 0 0");
  EXPECT_EQ(fault_of(arm + link("b", "-0.1", "0.01", "0 0 0.1") + joint("k", "a", "b", "0.5 0 0")), "");
  EXPECT_NE(fault_of(link("a", "-2", "0.1", "0.5 0 0") + joint("j", "ground", "a", "0 0 0")), "");
}

}  // namespace
}  // namespace codesign
