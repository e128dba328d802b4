// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include "assembly/count_equations.h"
#include "assembly/make_system.h"
#include "equations/compiled.h"
#include "integration/planar_linkages.h"
#include "mechanism_codesign/simulation.h"

namespace codesign {
namespace {

std::shared_ptr<const CompiledSystem> make(const std::string& urdf, const std::string& study) {
  const RobotDescription robot = read_urdf({"test.urdf", urdf});
  return make_system(robot, read_study({"test.yaml", study}, robot));
}

InputFault fault(const std::string& urdf, const std::string& study) {
  try {
    make(urdf, study);
  } catch (const InputError& error) {
    return error.fault();
  }
  ADD_FAILURE() << "accepted";
  return {};
}

std::string loop_at(double x) {
  return robot(
      bar("left") + bar("right") + hinge("left_hinge", "ground", "left", "0 0 0") +
      hinge("right_hinge", "ground", "right", std::to_string(x) + " 0 0") +
      "\n<loop name='tip' type='continuous'><predecessor link='left'><origin xyz='0 0 "
      "-1'/></predecessor>"
      "<successor link='right'><origin xyz='0 0 -1'/></successor><axis xyz='0 1 0'/></loop>");
}

const std::string kApart = "{left_hinge: {guess: -0.5}, right_hinge: {guess: 0.5}}";

Warnings warnings_of(const std::string& urdf, const std::string& study) {
  const RobotDescription robot = read_urdf({"test.urdf", urdf});
  Warnings warnings;
  make_system(robot, read_study({"test.yaml", study}, robot), &warnings);
  return warnings;
}

/// A parallelogram with friction in three of its hinges. @param mass_at where the mass of the
/// coupler is, across the plane [m].
/// @param loop the type of the loop. @param slides whether the right hinge can slide along its
/// axis.
std::string rubbing_four_bar(const std::string& mass_at, const std::string& loop = "continuous",
                             bool slides = false) {
  std::string text = four_bar(pin_friction());
  const auto replace = [&text](const std::string& from, const std::string& to) {
    text.replace(text.find(from), from.size(), to);
  };
  replace("<loop name='right_pin' type='continuous'>",
          "<loop name='right_pin' type='" + loop + "'>" + pin_friction());
  replace("<axis xyz='0 1 0'/></joint><loop",
          std::string("<axis xyz='0 1 0'/>") + pin_friction() + "</joint><loop");
  if (mass_at != "0") {
    const std::size_t coupler = text.find("<link name='coupler'>");
    text.replace(text.find("0 0 -0.5", coupler), 8, "0 " + mass_at + " -0.5");
  }
  if (slides) {  // the right hinge gets an axial play, by a massless link
    replace("<joint name='right_hinge' type='continuous'><parent link='ground'/>",
            "<link name='sleeve'/><joint name='play' type='prismatic'><parent "
            "link='ground'/><child link='sleeve'/><axis xyz='0 1 0'/>"
            "<limit effort='0' velocity='0'/></joint><joint name='right_hinge' "
            "type='continuous'><parent link='sleeve'/>");
  }
  return text;
}

std::string only_friction_warning(const std::string& urdf) {
  const Warnings warnings =
      warnings_of(urdf, let_go("{left_hinge: {position: 0.6}}", "left_hinge/velocity"));
  EXPECT_EQ(warnings.size(), 1U);
  if (warnings.empty()) return "";
  EXPECT_EQ(warnings[0].code, "undetermined_friction");
  return warnings[0].message;
}

TEST(MakeSystem, TheAdviceOfUndeterminedFrictionDeterminesIt) {
  const std::string message = only_friction_warning(rubbing_four_bar("0.2"));
  for (const char* part : {"'left_hinge', 'left_pin', 'right_pin' depends", "least norm",
                           "'right_pin' as codesign:spherical and '", "' as codesign:cylindrical"})
    EXPECT_NE(message.find(part), std::string::npos) << message;
  const std::string held = "by codesign:out_of_plane=\"zero\" on 'right_pin'";
  EXPECT_NE(message.find(held), std::string::npos) << message;
  EXPECT_TRUE(warnings_of(held_in_plane(rubbing_four_bar("0.2")),
                          let_go("{left_hinge: {position: 0.6}}", "left_hinge/velocity"))
                  .empty());
  // One joint is not enough, two are.
  EXPECT_NE(only_friction_warning(rubbing_four_bar("0.2", "codesign:spherical")), "");
  EXPECT_TRUE(warnings_of(rubbing_four_bar("0.2", "codesign:spherical", true),
                          let_go("{left_hinge: {position: 0.6}}", "left_hinge/velocity"))
                  .empty());
}

TEST(MakeSystem, UndeterminedFrictionWithoutEffectSaysSo) {
  const std::string message = only_friction_warning(rubbing_four_bar("0"));
  EXPECT_NE(message.find("changes friction by less than 1e-3"), std::string::npos) << message;
  EXPECT_EQ(only_friction_warning(rubbing_four_bar("0.2")).find("changes friction by less"),
            std::string::npos);
}

TEST(MakeSystem, OnlyRedundantConstraintsMakeItCompliant) {
  EXPECT_EQ(make(double_pendulum(), let_go("{}", "elbow/velocity"))->compliance(), 0.0);
  EXPECT_GT(make(four_bar(), let_go("{left_hinge: {position: 0.6}}", "left_hinge/velocity"))
                ->compliance(),
            0.0);
}

TEST(MakeSystem, ALoopThatCannotBeClosedIsNamedWithItsPlace) {
  EXPECT_NO_THROW(make(loop_at(1.2), let_go(kApart, "left_hinge/velocity")));
  const InputFault refused = fault(loop_at(2.5), let_go(kApart, "left_hinge/velocity"));
  EXPECT_EQ(refused.where.file, "test.urdf");
  EXPECT_EQ(refused.where.line, 2);
  EXPECT_EQ(refused.element, "<loop name=\"tip\">");
  // Two bars of 1 m cannot span 2.5 m; the closest position of the search is near the stretched
  // one.
  const std::string label = "misses by ";
  ASSERT_EQ(refused.value.substr(0, label.size()), label);
  EXPECT_NEAR(std::stod(refused.value.substr(label.size())), 500.0, 10.0) << "mm";
  EXPECT_NE(refused.allowed.find("closure_tolerance"), std::string::npos);
}

// Positions of all joints around a loop are rounded numbers: the miss is within closure_tolerance,
// which is not the way out.
TEST(MakeSystem, PositionsOfAllJointsOfALoopAreTooMany) {
  const auto start = [](const std::string& others) {
    return let_go("{left_hinge: {position: 0.6}, right_hinge: {" + others +
                      ": 0.6001}, left_pin: {" + others + ": -0.6}}",
                  "left_hinge/velocity");
  };
  const InputFault refused = fault(four_bar(), start("position"));
  EXPECT_NE(refused.message.find("leave no joint free to close the loop"), std::string::npos)
      << refused.message;
  EXPECT_NE(refused.allowed.find("the others a guess"), std::string::npos) << refused.allowed;
  EXPECT_EQ(refused.allowed.find("closure_tolerance"), std::string::npos) << refused.allowed;
  EXPECT_NO_THROW(make(four_bar(), start("guess")));
}

TEST(MakeSystem, SomethingMustMove) {
  const std::string study = let_go("{}", "ground/position/x");
  for (const char* content : {"",
                              "<link name='frame'/><joint name='j' type='continuous'><parent "
                              "link='ground'/><child link='frame'/></joint>"})
    EXPECT_NE(fault(robot(content), study).message.find("nothing moves"), std::string::npos);
}

TEST(MakeSystem, ContradictingVelocitiesAreBadInput) {
  const std::string study = let_go(
      "{left_hinge: {position: 0.6, velocity: 1.0}, right_hinge: {velocity: 2.0}, left_pin: "
      "{velocity: 0.0}}",
      "left_hinge/velocity");
  EXPECT_EQ(fault(four_bar(), study).element, "initial_state");
}

TEST(CountEquations, OfAFourBarDrawnInThePlane) {
  const auto system =
      make(four_bar(), let_go("{left_hinge: {position: 0.6}}", "left_hinge/velocity"));
  Status status;
  const Counts counts = count_equations(*system, {}, &status);
  ASSERT_TRUE(status.ok()) << status.cause;
  EXPECT_EQ(counts.bodies, 3);
  EXPECT_EQ(counts.coordinates, 21);
  EXPECT_EQ(counts.constraints, 23);
  EXPECT_EQ(counts.redundant_constraints, 3);
  EXPECT_EQ(counts.redundant_rows.size(), 3U);
  EXPECT_EQ(counts.degrees_of_freedom, 1);
  EXPECT_EQ(counts.dynamic_equations, 42 + 23);
  EXPECT_EQ(counts.total_equations, counts.dynamic_equations);
}

TEST(CountEquations, EachParameterHasItsSensitivities) {
  const std::string study =
      "duration: 1.0\ncontrollers: {hold: {type: pid, input: hinge/position, setpoint: 0.0, "
      "output: hinge, gains: {p: \"${Kp}\", i: "
      "1.0}}}\n"
      "parameters: {Kp: {initial: 1.0}}\nobjective: {integral: [{signal: hinge/velocity}]}\n";
  Status status;
  const Counts counts = count_equations(*make(pendulum(), study), {1.0}, &status);
  EXPECT_EQ(counts.controller_states, 1);
  EXPECT_EQ(counts.parameters, 1);
  EXPECT_EQ(counts.dynamic_equations, 14 + 6);
  EXPECT_EQ(counts.sensitivities, 20);
  EXPECT_EQ(counts.total_equations, 40);
  EXPECT_EQ(counts.degrees_of_freedom, 1);
}

// The advice is followed: with the joints as it says, nothing is undetermined any more.
TEST(MakeSystem, TheAdviceOfUndeterminedReactionsDeterminesThem) {
  const auto warnings = [](const std::string& urdf) {
    return warnings_of(urdf, let_go("{left_hinge: {position: 0.6}}", "right_pin/reaction_force/y"));
  };
  const Warnings found = warnings(four_bar());
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].code, "undetermined_reaction");
  const std::string& message = found[0].message;
  EXPECT_NE(message.find("'right_pin' as codesign:cylindrical"), std::string::npos) << message;
  EXPECT_NE(message.find("by codesign:out_of_plane=\"zero\" on 'right_pin'"), std::string::npos)
      << message;
  const auto with_loop = [](const std::string& type) {
    std::string urdf = four_bar();
    const std::string from = "<loop name='right_pin' type='continuous'>";
    urdf.replace(urdf.find(from), from.size(), "<loop name='right_pin' type='" + type + "'>");
    return urdf;
  };
  EXPECT_TRUE(warnings(with_loop("codesign:cylindrical")).empty());
  // A ball leaves the thrust undetermined, which the former advice allowed.
  EXPECT_EQ(warnings(with_loop("codesign:spherical")).size(), 1U);
  EXPECT_TRUE(warnings(held_in_plane(four_bar())).empty());
}

}  // namespace
}  // namespace codesign
