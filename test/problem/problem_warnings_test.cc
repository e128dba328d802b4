// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <set>

#include "description/study.h"
#include "ensemble/ensemble_fixture.h"
#include "problem/load_problem.h"
#include "problem/problem_warnings.h"

namespace codesign {
namespace {

Study study_with(double nominal, double found) {
  Study study;
  study.parameters = {{"mu", nominal, 0.0, 1.0, "", {}}};
  UncertainQuantity quantity{
      "mu", 0, {DistributionKind::kNormal, found, 0.01, 0.0, 1.0, {}}, {}, {"study.yaml", 7}};
  quantity.is_identified = true;
  quantity.spread = 0.02;
  study.ensemble.uncertain = {quantity};
  return study;
}

TEST(DifferingNominals, WarnsOfAModelWithoutTheIdentifiedValues) {
  const Warnings warnings = differing_nominals(study_with(0.3, 0.25));
  ASSERT_EQ(warnings.size(), 1U);
  EXPECT_EQ(warnings[0].code, "nominal_differs");
  EXPECT_EQ(warnings[0].where.line, 7);
  for (const char* part : {"mu 0.3", "0.25", "identified_overlay.urdf"})
    EXPECT_NE(warnings[0].message.find(part), std::string::npos) << warnings[0].message;
}

TEST(DifferingNominals, SaysNothingOfEqualValuesAndOfGuesses) {
  EXPECT_TRUE(differing_nominals(study_with(0.25, 0.25)).empty());
  EXPECT_TRUE(differing_nominals(study_with(0.25, 0.25 + 1e-9)).empty());
  Study guessed = study_with(0.3, 0.25);
  guessed.ensemble.uncertain[0].is_identified = false;
  EXPECT_TRUE(differing_nominals(guessed).empty());
}

/// A pendulum whose mass is `mass`, an attribute, with `more` inside the link; and a study of it
/// that tunes the parameter.
Problem problem_of(const std::string& mass, const std::string& more = "",
                   const std::string& study = "", const std::vector<SourceText>& overlays = {}) {
  return load_problem(
      {"pendulum.urdf",
       R"(<robot name="pendulum" xmlns:codesign="urn:mechanism_codesign">
  <codesign:parameter name="weight" value="3" lower="1" upper="5"/>
  <link name="ground"/>
  <link name="arm"><inertial><origin xyz="0 0 -1"/><mass value="3" )" +
           mass +
           R"(/><inertia ixx="0.1" ixy="0" ixz="0" iyy="0.1" iyz="0" izz="0.1"/></inertial>)" +
           more +
           R"(</link>
  <joint name="hinge" type="continuous"><parent link="ground"/><child link="arm"/><axis xyz="1 0 0"/></joint>
</robot>)"},
      overlays,
      {"swing.yaml",
       "duration: 1.0\nparameters: {weight: {}}\nobjective: {terminal: [{signal: "
       "hinge/position}]}\n" +
           study});
}

std::size_t warnings_of(const Problem& problem) {
  return unused_parameters(study_of(problem)).size();
}

TEST(UnusedParameters, AreTunedButMoveNothing) {
  const Problem problem = problem_of("");
  const Warnings warnings = unused_parameters(study_of(problem));
  ASSERT_EQ(warnings.size(), 1U);
  EXPECT_EQ(warnings[0].code, "unused_parameter");
  EXPECT_NE(warnings[0].message.find("${weight}"), std::string::npos) << warnings[0].message;
  EXPECT_EQ(problem.warnings().size(), 1U) << "the problem tells it";
}

TEST(UnusedParameters, ANumberOfModelOrStudyUsesThem) {
  EXPECT_EQ(warnings_of(problem_of("codesign:value=\"${weight}\"")), 0U);
  EXPECT_EQ(warnings_of(problem_of("", "", "loads: [{joint: hinge, effort: \"${2*weight}\"}]\n")),
            0U);
  EXPECT_EQ(warnings_of(problem_of("",
                                   "<visual><geometry><sphere radius=\"0.3\" "
                                   "codesign:radius=\"${weight/10}\"/></geometry></visual>")),
            0U);
}

TEST(UnusedParameters, TheChangesOfARunUseThem) {
  const Problem problem = problem_of(
      "", "", "runs: {pushed: {loads: [{joint: hinge, effort: \"${weight}\"}]}, free: {}}\n");
  EXPECT_EQ(warnings_of(problem), 0U);
  for (const char* run : {"pushed", "free"}) EXPECT_EQ(warnings_of(run_of(problem, run)), 0U);
}

TEST(UnusedParameters, AreUncertainButMoveNothing) {
  const auto warnings = [](const std::string& push) {
    return block("uncertain: {width: {uniform: [0.2, 0.4]}}\nloads: [{joint: slide, effort: \"" +
                     push + "\"}]\n",
                 "{algorithm: slsqp}", ", width: {tune: false, initial: 0.3}")
        .warnings();
  };
  EXPECT_TRUE(warnings("${width}").empty());
  ASSERT_EQ(warnings("1").size(), 1U);
  EXPECT_EQ(warnings("1")[0].code, "unused_parameter");
  EXPECT_NE(warnings("1")[0].message.find("uncertain.width"), std::string::npos)
      << warnings("1")[0].message;
  EXPECT_TRUE(block("uncertain: {friction_law: {choice: [gonthier, lugre]}}\n").warnings().empty());
}

TEST(UnusedParameters, CommentsAndConstraintsDoNotUseThem) {
  EXPECT_EQ(warnings_of(problem_of("", "<!-- ${weight} -->")), 1U);
  EXPECT_EQ(warnings_of(problem_of("", "", "# ${weight}\n")), 1U);
  EXPECT_EQ(warnings_of(problem_of("", "", "constraints: [\"weight >= 2\"]\n")), 1U);
}

TEST(UnusedParameters, WhatAnOverlayReplacesDoesNotUseThem) {
  const SourceText overlay{"overlay.urdf",
                           R"(<robot name="pendulum" xmlns:codesign="urn:mechanism_codesign">
    <link name="arm"><inertial><mass codesign:value="3"/></inertial></link></robot>)"};
  EXPECT_EQ(warnings_of(problem_of("codesign:value=\"${weight}\"", "", "", {overlay})), 1U);
}

TEST(UnusedParameters, SettingsAndOtherStudiesKeepTheRecord) {
  const Problem problem = problem_of("codesign:value=\"${weight}\"");
  EXPECT_EQ(warnings_of(with_settings(problem, {{"weight", 4.0}})), 0U);
  EXPECT_EQ(study_of(load_mechanism(problem.urdf(), {})).used_parameters, std::set<int>{0});
}

Study study_with(Interpolation interpolation, const std::vector<double>& positions,
                 const std::vector<double>& velocities = {}) {
  Study study;
  ControllerDescription controller;
  controller.name = "hold";
  controller.where = {"study.yaml", 7};
  controller.setpoint.kind = ReferenceDescription::Kind::kWaypoints;
  WaypointsDescription& points = controller.setpoint.waypoints;
  points.interpolation = interpolation;
  for (std::size_t k = 0; k < positions.size(); ++k)
    points.times.push_back(static_cast<double>(k * k));
  points.positions.assign(positions.begin(), positions.end());
  points.velocities.assign(velocities.begin(), velocities.end());
  study.controllers = {controller};
  return study;
}

TEST(WaypointOvershoot, NamesTheCurveThatLeavesItsWayPoints) {
  const Warnings warnings =
      waypoint_overshoots(study_with(Interpolation::kQuintic, {0.0, 10.0, 10.0}));
  ASSERT_EQ(warnings.size(), 1U);
  EXPECT_EQ(warnings[0].code, "waypoint_overshoot");
  EXPECT_EQ(warnings[0].where.line, 7);
  for (const char* part : {"controllers.hold.setpoint", "0 to 10", "interpolation"})
    EXPECT_NE(warnings[0].message.find(part), std::string::npos) << warnings[0].message;
  EXPECT_EQ(
      waypoint_overshoots(study_with(Interpolation::kMonotone, {0.0, 1.0}, {-5.0, 0.0})).size(), 1U)
      << "given velocities";
}

TEST(WaypointOvershoot, SaysNothingOfCurvesWithinTheirWayPoints) {
  EXPECT_TRUE(waypoint_overshoots(study_with(Interpolation::kMonotone, {0.0, 10.0, 10.0})).empty());
  EXPECT_TRUE(waypoint_overshoots(study_with(Interpolation::kQuintic, {0.0, 1.0})).empty());
  EXPECT_TRUE(waypoint_overshoots(study_with(Interpolation::kQuintic, {2.0, 2.0, 2.0})).empty());
  EXPECT_TRUE(waypoint_overshoots(study_with(Interpolation::kQuintic, {2.0})).empty());
  EXPECT_TRUE(waypoint_overshoots(Study()).empty());
}

}  // namespace

}  // namespace codesign
