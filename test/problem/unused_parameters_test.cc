// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "problem/unused_parameters.h"

#include <gtest/gtest.h>

#include <set>

#include "ensemble/ensemble_fixture.h"
#include "problem/load_problem.h"

namespace codesign {
namespace {

/// A pendulum whose mass is `mass`, an attribute, with `more` inside the link; and a study of it that tunes the parameter.
Problem problem_of(const std::string& mass, const std::string& more = "", const std::string& study = "",
                   const std::vector<SourceText>& overlays = {}) {
  return load_problem(
      {"pendulum.urdf", R"(<robot name="pendulum" xmlns:codesign="urn:mechanism_codesign">
  <codesign:parameter name="weight" value="3" lower="1" upper="5"/>
  <link name="ground"/>
  <link name="arm"><inertial><origin xyz="0 0 -1"/><mass value="3" )" +
                            mass + R"(/><inertia ixx="0.1" ixy="0" ixz="0" iyy="0.1" iyz="0" izz="0.1"/></inertial>)" + more +
                            R"(</link>
  <joint name="hinge" type="continuous"><parent link="ground"/><child link="arm"/><axis xyz="1 0 0"/></joint>
</robot>)"},
      overlays, {"swing.yaml", "duration: 1.0\nparameters: {weight: {}}\nobjective: {terminal: [{signal: hinge/position}]}\n" + study});
}

std::size_t warnings_of(const Problem& problem) { return unused_parameters(problem.study()).size(); }

TEST(UnusedParameters, AreTunedButMoveNothing) {
  const Problem problem = problem_of("");
  const Warnings warnings = unused_parameters(problem.study());
  ASSERT_EQ(warnings.size(), 1U);
  EXPECT_EQ(warnings[0].code, "unused_parameter");
  EXPECT_NE(warnings[0].message.find("${weight}"), std::string::npos) << warnings[0].message;
  EXPECT_EQ(problem.warnings().size(), 1U) << "the problem tells it";
}

TEST(UnusedParameters, ANumberOfModelOrStudyUsesThem) {
  EXPECT_EQ(warnings_of(problem_of("codesign:value=\"${weight}\"")), 0U);
  EXPECT_EQ(warnings_of(problem_of("", "", "loads: [{joint: hinge, effort: \"${2*weight}\"}]\n")), 0U);
  EXPECT_EQ(warnings_of(problem_of("", "<visual><geometry><sphere radius=\"0.3\" codesign:radius=\"${weight/10}\"/></geometry></visual>")),
            0U);
}

TEST(UnusedParameters, TheChangesOfARunUseThem) {
  EXPECT_EQ(warnings_of(problem_of("", "", "runs: {pushed: {loads: [{joint: hinge, effort: \"${weight}\"}]}}\n")), 0U);
}

TEST(UnusedParameters, AreUncertainButMoveNothing) {
  const auto warnings = [](const std::string& push) {
    return block("uncertain: {width: {uniform: [0.2, 0.4]}}\nloads: [{joint: slide, effort: \"" + push + "\"}]\n", "{algorithm: slsqp}",
                 ", width: {tune: false, initial: 0.3}")
        .warnings();
  };
  EXPECT_TRUE(warnings("${width}").empty());
  ASSERT_EQ(warnings("1").size(), 1U);
  EXPECT_EQ(warnings("1")[0].code, "unused_parameter");
  EXPECT_NE(warnings("1")[0].message.find("uncertain.width"), std::string::npos) << warnings("1")[0].message;
  EXPECT_TRUE(block("uncertain: {friction_law: {choice: [gonthier, lugre]}}\n").warnings().empty());
}

TEST(UnusedParameters, CommentsAndConstraintsDoNotUseThem) {
  EXPECT_EQ(warnings_of(problem_of("", "<!-- ${weight} -->")), 1U);
  EXPECT_EQ(warnings_of(problem_of("", "", "# ${weight}\n")), 1U);
  EXPECT_EQ(warnings_of(problem_of("", "", "constraints: [\"weight >= 2\"]\n")), 1U);
}

TEST(UnusedParameters, WhatAnOverlayReplacesDoesNotUseThem) {
  const SourceText overlay{"overlay.urdf", R"(<robot name="pendulum" xmlns:codesign="urn:mechanism_codesign">
    <link name="arm"><inertial><mass codesign:value="3"/></inertial></link></robot>)"};
  EXPECT_EQ(warnings_of(problem_of("codesign:value=\"${weight}\"", "", "", {overlay})), 1U);
}

TEST(UnusedParameters, SettingsAndOtherStudiesKeepTheRecord) {
  const Problem problem = problem_of("codesign:value=\"${weight}\"");
  EXPECT_EQ(warnings_of(with_settings(problem, {{"weight", 4.0}})), 0U);
  EXPECT_EQ(load_mechanism(problem.urdf(), {}).study().used_parameters, std::set<int>{0});
}

}  // namespace
}  // namespace codesign
