// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "mechanism/signal_axes.h"

#include <gtest/gtest.h>

#include "description/motion_study.h"
#include "mechanism/signal_catalog.h"
#include "reading/urdf/urdf_fixture.h"

namespace codesign {
namespace {

/// Ground - crank - rod, ground - slider with a plate fixed to it, ground - rocker, whose foot is
/// turned; the rod ends at the slider, with a frame that is turned.
RobotDescription machine() {
  return read_urdf(robot_text(
      kGround + link_with("crank") + link_with("rod") + link_with("slider") + link_with("plate") +
      link_with("rocker") + joint_with("turn", "continuous", "ground", "crank") +
      joint_with("knee", "continuous", "crank", "rod") +
      joint_with("slide", "prismatic", "ground", "slider",
                 "<limit lower='-1' upper='1' effort='1' velocity='1'/>") +
      joint_with("mount", "fixed", "slider", "plate") +
      joint_with("pivot", "continuous", "plate", "rocker", "<origin rpy='0 0 0.3'/>") +
      "<loop name='pin' type='revolute'><predecessor link='rod'><origin xyz='0 0 1'/></predecessor>"
      "<successor link='slider'><origin rpy='0 0.2 0'/></successor><axis xyz='0 1 0'/></loop>"));
}

void check_in_machine(const std::string& text) {
  static const RobotDescription kMachine = machine();
  check_signal(parse_signal(text, {"s.yaml", 3}, "here"), kMachine, {}, "here");
}

std::string refusal_of(const std::string& text) {
  try {
    check_in_machine(text);
  } catch (const InputError& error) {
    EXPECT_EQ(error.fault().where.line, 3);
    EXPECT_EQ(error.fault().element, "here");
    EXPECT_EQ(error.fault().value, text);
    return error.fault().message + " | " + error.fault().allowed;
  }
  ADD_FAILURE() << "accepted " << text;
  return "";
}

TEST(SignalAxes, ASumOfUnlikeAxesIsRefusedWithTheSumThatHasAMeaning) {
  const std::string text = refusal_of("turn/reaction_force/x + pivot/reaction_force/x");
  EXPECT_NE(text.find("of link 'crank' and of link 'rocker'"), std::string::npos) << text;
  EXPECT_NE(text.find("turn/reaction_force/x@ground, pivot/reaction_force/x@ground"),
            std::string::npos)
      << text;
  for (const char* sum :
       {"turn/reaction_force/x - knee/reaction_force/x",
        "turn/reaction_torque/y + knee/"
        "reaction_torque/y",
        "turn/reaction_force/x@ground + knee/reaction_force/x",
        "knee/reaction_force/x@crank - knee/reaction_force/x@rod",
        "pin/reaction_force/x + slide/reaction_force/x",
        "rod/imu_acceleration/x - crank/imu_acceleration/x",
        "rod/acceleration/z - rod/imu_acceleration/z",
        "mechanism/shaking_force/x + turn/reaction_force/x",
        "${turn/reaction_force/x + pivot/reaction_force/x}",
        "${2*turn/reaction_force/x - (slide/position + pivot/reaction_force/x/3)}",
        "${max(0, turn/reaction_force/x - knee/reaction_force/x)}",
        "${(turn/reaction_force/x + knee/reaction_force/x)^2}"})
    EXPECT_NE(refusal_of(sum).find("component of nothing"), std::string::npos) << sum;
}

TEST(SignalAxes, SumsInTheSameAxesAndOfOtherThingsAreTaken) {
  for (const char* sum :
       {"turn/reaction_force/x@ground + knee/reaction_force/x@ground",
        "turn/reaction_force/x + turn/reaction_force/z",
        "turn/reaction_force/x + knee/reaction_force/x@crank",
        // What only slides or is fixed turns with what carries it.
        "slide/reaction_force/x + turn/reaction_force/x@ground",
        "slide/reaction_force/x - turn/reaction_force/x@plate",
        "mechanism/shaking_force/x + slide/reaction_force/x",
        "mechanism/shaking_moment/z@plate - mechanism/shaking_moment/z",
        // Other units and scalars.
        "turn/reaction_force/x + knee/reaction_torque/x", "slide/position - plate/position/x",
        "crank/velocity/x - rod/velocity/x", "turn/effort + knee/reaction_torque/z",
        // Magnitudes and functions of components.
        "${turn/reaction_force/x^2 + knee/reaction_force/x^2}",
        "${sqrt(turn/reaction_force/x*turn/reaction_force/x) + abs(knee/reaction_force/x)}",
        "${max(turn/reaction_force/x, knee/reaction_force/x)}",
        "${turn/position > 0 ? turn/reaction_force/x : knee/reaction_force/x}",
        "${turn/reaction_force/x > 0 and knee/reaction_force/x > 0 ? 1 : 0}"})
    EXPECT_NO_THROW(check_in_machine(sum)) << sum;
}

TEST(SignalAxes, OnlyVectorsHaveThem) {
  for (const char* text : {"crank/position/x@ground", "crank/orientation/w@rod",
                           "turn/velocity@ground", "${turn/position + rod/position/z@crank}"})
    EXPECT_NE(refusal_of(text).find("only vectors"), std::string::npos) << text;
  const std::string unknown = refusal_of("turn/reaction_force/x@crnk");
  EXPECT_NE(unknown.find("did you mean \"crank\""), std::string::npos) << unknown;
}

TEST(SignalAxes, AnyNameOfTheRootLinkAndGroundAreTheGround) {
  RobotDescription robot = machine();
  SignalTerm term;
  term.axes = "ground";
  EXPECT_EQ(link_of_axes(term, robot), robot.root);
  robot.links[0].name = "world";
  EXPECT_EQ(link_of_axes(term, robot), robot.root);
  term.axes = "world";
  EXPECT_EQ(link_of_axes(term, robot), robot.root);
  robot.links[2].name = "ground";
  term.axes = "ground";
  EXPECT_EQ(link_of_axes(term, robot), 2) << "a link of that name goes before";
}

}  // namespace
}  // namespace codesign
