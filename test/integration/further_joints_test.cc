// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
// Joints of the tree that URDF lacks, by codesign:type.
#include <gtest/gtest.h>

#include <cmath>
#include <utility>

#include "integration/mechanisms.h"
#include "integration/signals_at.h"
#include "mechanism_codesign/error.h"
#include "problem/load_problem.h"

namespace codesign {
namespace {

/// @param overlays further annotations
Problem loaded_joints(const std::string& joints, const std::string& start,
                      const std::vector<SourceText>& overlays = {}) {
  return load_problem(
      {"joints.urdf",
       robot("<link name='bob'><inertial><origin xyz='0 0 -0.5'/><mass value='1'/><inertia "
             "ixx='0.01' ixy='0' ixz='0' iyy='0.012' iyz='0' izz='0.005'/></inertial></link><link "
             "name='tip'/><joint name='end' type='fixed'><parent link='bob'/><child link='tip'/>"
             "<origin xyz='0.1 0 -1'/></joint>" +
             joints)},
      overlays,
      {"joints.yaml", "duration: 1.0\ninitial_state: {" + start +
                          "}\nsolver: {relative_tolerance: 1.0e-10, absolute_tolerance: "
                          "1.0e-12}\n"},
      {}, TrajectoryLoader(), FileLoader());
}

std::vector<double> tip_at(const Problem& problem, double time) {
  return signals_at(problem, time, {"tip/position/x", "tip/position/y", "tip/position/z"});
}

std::string by_type(const std::string& type, const std::string& more = "") {
  return "<joint name='j' type='floating' codesign:type='" + type +
         "'><parent link='ground'/><child link='bob'/>" + more + "</joint>";
}

std::string hinge_about(const std::string& name, const std::string& parent,
                        const std::string& child, const std::string& axis) {
  return "<joint name='" + name + "' type='continuous'><parent link='" + parent +
         "'/><child link='" + child + "'/><axis xyz='" + axis + "'/></joint>";
}

// w = Rz Ry e_x x' + Rz e_y y' + e_z z'.
TEST(FurtherJoints, ABallMovesAsThreeHinges) {
  const Problem ball = loaded_joints(
      by_type("spherical"),
      "j: {rotation: [0.5, 0.2, 0.1], angular_velocity: [\"${0.7*cos(0.2)*cos(0.1) + "
      "0.4*sin(0.1)}\", \"${0.7*cos(0.2)*sin(0.1) - 0.4*cos(0.1)}\", \"${2 - 0.7*sin(0.2)}\"]}");
  const Problem hinges = loaded_joints(
      "<link name='a'/><link name='b'/>" + hinge_about("z", "ground", "a", "0 0 1") +
          hinge_about("y", "a", "b", "0 1 0") + hinge_about("x", "b", "bob", "1 0 0"),
      "z: {position: 0.1, velocity: 2.0}, y: {position: 0.2, velocity: -0.4}, x: {position: 0.5, "
      "velocity: 0.7}");
  for (const double time : {0.3, 1.0}) {
    const std::vector<double> one = tip_at(ball, time), other = tip_at(hinges, time);
    for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(one[k], other[k], 3e-8) << time;
  }
}

// It slides along the vertical freely, and turns with a constant rate.
TEST(FurtherJoints, ACylindricalJointSlidesAndTurns) {
  const Problem sleeve =
      loaded_joints(by_type("cylindrical", "<axis xyz='0 0 1'/>"),
                    "j: {translation: [0, 0, 0.2], rotation: 0.3, linear_velocity: [0, 0, 1.5], "
                    "angular_velocity: 2.0}");
  const std::vector<double> tip = tip_at(sleeve, 1.0);
  EXPECT_NEAR(tip[0], 0.1 * std::cos(2.3), 1e-10);
  EXPECT_NEAR(tip[1], 0.1 * std::sin(2.3), 1e-10);
  EXPECT_NEAR(tip[2], 0.2 + 1.5 - 0.5 * 9.81 - 1.0, 1e-9);
}

TEST(FurtherJoints, ComplaintsOfWhatTheyHaveNot) {
  const auto complaint = [](const std::string& joints, const std::string& start,
                            const std::vector<SourceText>& overlays = {}) {
    try {
      loaded_joints(joints, start, overlays);
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_NE(complaint(by_type("spherical"), "j: {translation: [1, 0, 0]}").find("does not slide"),
            std::string::npos);
  EXPECT_NE(complaint(by_type("cylindrical", "<axis xyz='0 0 1'/>"), "j: {rotation: [0, 0, 1]}")
                .find("turns only about its axis"),
            std::string::npos);
  EXPECT_NE(complaint(by_type("cylindrical",
                              "<axis xyz='0 0 1'/><limit lower='0' upper='1' effort='1' "
                              "velocity='1'/>"),
                      "j: {rotation: 0}")
                .find("no single coordinate for a limit"),
            std::string::npos);
  const SourceText damped{"damped.urdf",
                          "<robot><joint name='j'><dynamics damping='5'/></joint></robot>"};
  const std::pair<const char*, const char*> starts[] = {{"cylindrical", "j: {rotation: 0}"},
                                                        {"spherical", "j: {rotation: [0, 0, 0]}"}};
  for (const auto& [type, start] : starts) {
    const std::string joint = by_type(type, "<axis xyz='0 0 1'/>");
    EXPECT_EQ(complaint(joint, start), "") << type;
    EXPECT_NE(complaint(joint, start, {damped}).find("without a scalar coordinate"),
              std::string::npos)
        << type;
  }
}

}  // namespace
}  // namespace codesign
