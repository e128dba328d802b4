// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "mechanism/body_check.h"

#include "reading/urdf/urdf_fixture.h"

namespace codesign {
namespace {

std::string inertial(const std::string& mass, const std::string& ixx, const std::string& iyy, const std::string& izz) {
  return "<inertial><mass value=\"" + mass + "\"/><inertia ixx=\"" + ixx + "\" ixy=\"0\" ixz=\"0\" iyy=\"" + iyy + "\" iyz=\"0\" izz=\"" +
         izz + "\"/></inertial>";
}

/// An arm with this inertial on a hinge, and a part fixed to the arm.
SourceText arm(const std::string& numbers, const std::string& part = "") {
  return robot_text(kGround + link_with("arm", numbers) + joint_with("hinge", "continuous", "ground", "arm") + "\n" +
                    (part.empty() ? "" : link_with("part", part) + joint_with("weld", "fixed", "arm", "part")));
}

TEST(BodyCheck, WhatNoBodyCanHaveIsAWarning) {
  expect_warning(arm(inertial("-1", "1", "1", "1")), "negative_mass",
                 {"test.urdf:2: <link name=\"arm\"> <inertial>: the mass is negative"});
  expect_warning(arm(inertial("1", "-1", "1", "1")), "inertia_not_positive", {"principal moments -1 1 1", "used as it is written"});
  expect_warning(arm(inertial("1", "1", "1", "2.1")), "triangle_inequality", {"principal moments 1 1 2.1"});
  EXPECT_EQ(read_urdf(arm(inertial("1", "1", "1", "2.1"))).links[1].inertial->inertia[5].nominal(), 2.1);
}

TEST(BodyCheck, IdealBodiesAreFine) {
  expect_no_warning(arm(inertial("1", "1", "1", "2")));           // flat
  expect_no_warning(arm(inertial("1", "1", "1", "2.000001")));    // flat, and rounded
  expect_no_warning(arm(inertial("1", "1", "1", "0")));           // a rod
  expect_no_warning(arm(inertial("1", "0", "0", "0")));           // a point
  expect_no_warning(arm(inertial("0", "1", "1", "1")));           // a rotor without mass
  expect_no_warning(arm(inertial("1", "-1e-20", "0", "1e-19")));  // rounding of a point
}

TEST(BodyCheck, LinksThatAreWeldedTogetherAreJudgedAsOne) {
  const std::string heavy = inertial("1", "1", "1", "1");
  expect_no_warning(arm(heavy, inertial("0", "0.1", "0.1", "0.1")));
  expect_no_warning(arm(heavy, inertial("0.1", "0", "0", "0.3")));
  expect_no_warning(arm(heavy, inertial("-0.1", "-0.1", "0.1", "0.1")));
  expect_warning(arm(heavy, inertial("-2", "1", "1", "1")), "negative_mass", {"<link name=\"arm\">", "links: arm, part"});
  expect_error(arm(heavy, inertial("-1", "1", "1", "1")), {"test.urdf:2:", "fixed to each other cancel", "value: arm, part"});
}

TEST(BodyCheck, TheRootIsNotJudged) {
  const auto on_base = [](const std::string& base) {
    return robot_text(link_with("base", base) + link_with("arm") + joint_with("hinge", "continuous", "base", "arm"));
  };
  expect_no_warning(on_base(inertial("-1", "-1", "0", "3")));
  expect_no_warning(on_base(inertial("0", "1", "1", "1")));
}

}  // namespace
}  // namespace codesign
