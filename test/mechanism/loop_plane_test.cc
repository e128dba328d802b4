// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "mechanism/loop_plane.h"

#include <gtest/gtest.h>

#include <cmath>

#include "integration/planar_linkages.h"
#include "mechanism/constants.h"

namespace codesign {
namespace {

std::string changed(std::string urdf, const std::string& from, const std::string& to) {
  const std::size_t at = urdf.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return urdf.replace(at, from.size(), to);
}

Topology loop_topology(const std::string& urdf) {
  return derive_topology(read_urdf({"t.urdf", urdf}));
}

/// What is wrong with a linkage that says that it is planar.
void expect_out_of_plane(const std::string& urdf, const std::string& message,
                         const std::string& value) {
  try {
    loop_topology(held_in_plane(urdf));
    ADD_FAILURE() << "taken: " << message;
  } catch (const InputError& error) {
    const std::string text = error.what();
    for (const std::string& part : {message, value, std::string("<loop name=")})
      EXPECT_NE(text.find(part), std::string::npos) << part << " in:\n" << text;
  }
}

TEST(LoopPlane, TheJointsAroundALoopLeadBackToItsPredecessor) {
  const RobotDescription robot = read_urdf({"t.urdf", held_in_plane(four_bar())});
  const Topology t = derive_topology(robot);
  const Pair& loop = t.pairs.back();
  ASSERT_EQ(loop.name, "right_pin");
  std::string names;
  for (const ChainElement& element : loop.around)
    names += (element.reversed ? " -" : " ") + robot.joints[to_index(element.joint)].name;
  EXPECT_EQ(names, " -right_hinge left_hinge left_pin -right_pin");
}

TEST(LoopPlane, LoopsAreCutToTheirPlane) {
  const Topology ring = loop_topology(held_in_plane(four_bar())),
                 slide = loop_topology(held_in_plane(block_on_a_loop())),
                 weld = loop_topology(held_in_plane(welded_four_bar()));
  EXPECT_EQ(ring.pairs.back().kind->rows, 2);
  EXPECT_EQ(slide.pairs.back().kind->rows, 2);
  EXPECT_EQ(weld.pairs.back().kind->rows, 3);
  for (const Pair& pair : loop_topology(four_bar()).pairs) {
    EXPECT_EQ(pair.kind, PairKind::kRevolute);
    EXPECT_TRUE(pair.around.empty());
  }
}

TEST(LoopPlane, ASlideHasTheNormalAsItsSecondAxis) {
  const RobotDescription robot = read_urdf({"t.urdf", held_in_plane(block_on_a_loop())});
  const Topology t = derive_topology(robot);
  const auto constants = evaluate_constants(robot, t, default_values(robot));
  const PairConstants<double>& slide = constants.pairs.back();
  EXPECT_NEAR((slide.C_i.col(1) - Vector3<double>::UnitY()).norm(), 0.0, 1e-15);
  EXPECT_NEAR((slide.C_j.col(1) - Vector3<double>::UnitY()).norm(), 0.0, 1e-15);
  const Vector3<double> along(std::cos(1.3), 0.0, -std::sin(1.3));
  EXPECT_NEAR((slide.C_i.col(2) - along).norm(), 0.0, 1e-15);
}

TEST(LoopPlane, RefusesWhatMovesOutOfThePlane) {
  expect_out_of_plane(changed(four_bar(), "<axis xyz='0 1 0'/>", "<axis xyz='0.1 1 0'/>"),
                      "joint 'left_hinge' turns about an axis that is not normal to the plane",
                      "0.09966865");
  const std::string slides =
      changed(four_bar(), "'left_pin' type='continuous'", "'left_pin' type='prismatic'");
  expect_out_of_plane(changed(slides, "rpy='0 -1.5707963267948966 0'/><axis xyz='0 1 0'/>",
                              "/><axis xyz='1 0.2 0'/><limit effort='1' velocity='1'/>"),
                      "joint 'left_pin' slides along an axis that is not in the plane",
                      "0.1973955");
  expect_out_of_plane(
      changed(four_bar(), "'right_hinge' type='continuous'", "'right_hinge' type='floating'"),
      "joint 'right_hinge' is of a type that moves out of the plane", "");
  expect_out_of_plane(changed(block_on_a_loop(), "<axis xyz='1 0 0'/>", "<axis xyz='1 0.01 0'/>"),
                      "the loop slides along an axis that is not in the plane", "0.0099996");
}

TEST(LoopPlane, RefusesLoopsThatMissThemselvesAcrossThePlane) {
  expect_out_of_plane(changed(four_bar(), "xyz='1.2 0 0'", "xyz='1.2 0.005 0'"),
                      "predecessor and successor are apart along the normal of the plane", "5 mm");
  expect_out_of_plane(changed(four_bar(), "<origin xyz='0 0 -1.2'/>",
                              "<origin xyz='0 0 -1.2' rpy='3.141592653589793 0 0'/>"),
                      "the normals of the plane at predecessor and successor differ", "3.141592");
  // Angles written with five digits are taken.
  loop_topology(held_in_plane(changed(four_bar(), "<origin xyz='0 0 -1.2'/>",
                                      "<origin xyz='0 0 -1.2' rpy='0.00001 0 0'/>")));
}

TEST(LoopPlane, RefusesLoopsWithoutATurn) {
  const std::string slide =
      "<joint name='x' type='prismatic'><parent link='ground'/><child link='a'/><axis xyz='1 0 "
      "0'/><limit effort='1' velocity='1'/></joint><joint name='z' type='prismatic'><parent "
      "link='a'/><child link='b'/><axis xyz='0 0 1'/><limit effort='1' velocity='1'/></joint>";
  expect_out_of_plane(
      robot(bar("a") + bar("b") + slide +
            "<loop name='close' type='prismatic'><predecessor link='ground'/><successor "
            "link='b'/><axis xyz='1 0 1'/></loop>"),
      "no joint around it turns", "");
}

TEST(LoopPlane, RefusesATransverseAxisBetweenPlaneAndNormal) {
  const auto with = [](const std::string& axis) {
    return block_on_a_loop(
        "<codesign:friction mu_static='0.2' mu_dynamic='0.15' joint_length='0.1' "
        "joint_width='0.06' transverse_axis='" +
        axis + "'/>");
  };
  expect_out_of_plane(with("0 1 0.5"), "transverse_axis of its friction", "0.4636476");
  for (const char* axis : {"0 1 0", "0 0 1", "1 0 1"}) loop_topology(held_in_plane(with(axis)));
}

TEST(LoopPlane, RefusesFoldedLoops) {
  const std::string stage =
      "<link name='stage'/><joint name='slide_x' type='prismatic'><parent link='ground'/><child "
      "link='stage'/><axis xyz='1 0 0'/><limit effort='1' velocity='1'/></joint>";
  expect_out_of_plane(
      robot(bar("a") + hinge("pin", "ground", "a", "0 0 0") + stage +
            "<loop name='close' type='prismatic'><predecessor link='stage'/><successor "
            "link='a'/><axis xyz='0 0 1'/></loop>"),
      "folded with joints across links without <inertial>", "slide_x+close");
}

}  // namespace
}  // namespace codesign
