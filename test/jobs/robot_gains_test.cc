// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <yaml-cpp/yaml.h>
#include <algorithm>

#include "description/study.h"
#include "jobs/robot_gains.h"
#include "jobs/tuned_pendulum.h"
#include "problem/load_problem.h"

namespace codesign {
namespace {

TEST(RobotGainsOfAStudy, AreThoseOfTheDesign) {
  const Problem problem = pendulum_on_hardware();
  Eigen::VectorXd rho = problem.start();
  rho[1] = 3.25;  // Kp
  const std::vector<RobotGains> all = robot_gains(problem, problem.parameters(rho));
  ASSERT_EQ(all.size(), 1U);
  EXPECT_EQ(all[0].name_space, "arm_controller/gains/hinge");
  EXPECT_EQ(all[0].controller, "hold");
  EXPECT_EQ(all[0].joint, "hinge");
  EXPECT_EQ((std::vector<double>{all[0].p, all[0].i, all[0].d, all[0].i_clamp_max}),
            (std::vector<double>{3.25, 0.25, 0.0, 2.0}));
  EXPECT_TRUE(all[0].antiwindup);
  EXPECT_FALSE(all[0].loses_weight);
}

TEST(RobotGainsOfAStudy, WithoutHardwareThereAreNone) {
  EXPECT_TRUE(robot_gains(pendulum(), pendulum().parameters()).empty());
}

/// With another name of the controller.
std::string gains_of(const std::string& controller) {
  const Problem problem = pendulum_on_hardware();
  Study study = study_of(problem);
  study.controllers.at(0).name = study.hardware.at(0).controller = controller;
  return gains_yaml(with_study(problem, study), problem.parameters());
}

TEST(GainsYaml, WithoutHardwareThereIsNone) {
  EXPECT_EQ(gains_yaml(pendulum(), pendulum().parameters()), "");
}

TEST(GainsYaml, NamesRateLimitsAndWhatDrivesTheJointBesideIt) {
  const Problem problem = pendulum_on_hardware();
  Study study = study_of(problem);
  study.controllers.at(0).realization.rate_limit = ControlBounds{Quantity(5.0), std::nullopt};
  ControllerDescription ahead;
  ahead.name = "ahead";
  ahead.kind = ControllerKind::kStateFeedback;
  ahead.output = study.controllers.at(0).output;
  study.controllers.push_back(ahead);
  const std::string text = gains_yaml(with_study(problem, study), problem.parameters());
  EXPECT_NE(text.find("not in these gains, as the study has it: "), std::string::npos) << text;
  EXPECT_NE(text.find("rate_limit, the output of ahead beside it"), std::string::npos) << text;
}

TEST(GainsYaml, HoldsWhatControlToolboxReads) {
  const Problem problem = pendulum_on_hardware();
  Eigen::VectorXd rho = problem.start();
  rho[1] = 1e-6;  // Kp
  const std::string text = gains_yaml(problem, problem.parameters(rho));
  const YAML::Node gains = YAML::Load(text)["arm_controller"]["gains"]["hinge"];
  ASSERT_TRUE(gains) << text;
  EXPECT_EQ(gains.size(), 5U);
  EXPECT_EQ(gains["p"].as<double>(), 1e-6);
  EXPECT_EQ(gains["i"].as<double>(), 0.25);
  EXPECT_EQ(gains["d"].as<double>(), 0.0);
  EXPECT_EQ(gains["i_clamp"].as<double>(), 2.0);
  EXPECT_TRUE(gains["antiwindup"].as<bool>());
  // rosparam takes a number without a decimal point and with an exponent for a text.
  EXPECT_NE(text.find("p: 1.0e-06"), std::string::npos) << text;
  EXPECT_NE(text.find("d: 0.0\n"), std::string::npos) << text;
}

/// The text of the pendulum whose controller has further keys; its hardware entry has no clamp.
std::string gains_with(const std::string& keys) {
  const Problem problem = pendulum_on_hardware();
  const std::string bare =
      replaced(problem.study_text().text, ", i_clamp: 2.0, antiwindup: true}", "}");
  const Problem with =
      load_problem(problem.urdf(), {}, {"a.yaml", replaced(bare, "i: 0.25}", "i: 0.25}" + keys)});
  return gains_yaml(with, with.parameters());
}

TEST(GainsYaml, HasTwoBoundsWhereTheyDiffer) {
  const std::string text = gains_with(", i_clamp: [-0.5, 2.0], antiwindup: clamping");
  const YAML::Node gains = YAML::Load(text)["arm_controller"]["gains"]["hinge"];
  EXPECT_EQ(gains["i_clamp_max"].as<double>(), 2.0);
  EXPECT_EQ(gains["i_clamp_min"].as<double>(), -0.5);
  EXPECT_FALSE(gains["i_clamp"]) << "control_toolbox would read it first";
  EXPECT_TRUE(gains["antiwindup"].as<bool>());
  EXPECT_EQ(text.find("not in these gains"), std::string::npos) << text;
}

TEST(GainsYaml, SaysWhatTheToolboxDoesNot) {
  const std::string text = gains_with(
      ", i_clamp: 2.0, output_limit: 3.0, antiwindup: back_calculation, filter: {type: low_pass, "
      "frequency: 20.0}");
  EXPECT_NE(text.find("hinge; not in these gains, as the study has it: filter, output_limit, "
                      "antiwindup: back_calculation\n"),
            std::string::npos)
      << text;
  EXPECT_FALSE(YAML::Load(text)["arm_controller"]["gains"]["hinge"]["antiwindup"].as<bool>());
}

TEST(GainsYaml, NamesStayInTheirComments) {
  // All line ends of YAML 1.1, and what its readers refuse: control characters, bytes that are not
  // UTF-8, U+FFFE.
  const char* const parts[] = {"\n",   "\r",   "\xc2\x85", "\xe2\x80\xa8", "\xe2\x80\xa9",
                               "\x01", "\x7f", "\xff",     "\xef\xbf\xbe"};
  for (const std::string part : parts) {
    const std::string text = gains_of("c" + part + "evil: {p: 1}" + part + "#");
    EXPECT_TRUE(std::all_of(text.begin(), text.end(), [](char c) {
      return c == '\n' || (c >= ' ' && c <= '~');
    })) << text;
    EXPECT_EQ(YAML::Load(text).size(), 1U) << text;
  }
  EXPECT_NE(gains_of("hold 1").find(": hold 1 of the study, which drives hinge\n"),
            std::string::npos)
      << "as it is";
}

TEST(GainsYaml, SoDoNamesOfJoints) {
  const auto renamed = [](std::string text, const std::string& name) {
    for (std::size_t at = 0; (at = text.find("hinge", at)) != std::string::npos; at += name.size())
      text.replace(at, 5, name);
    return text;
  };
  const Problem plain = pendulum();
  const std::string study = renamed(plain.study_text().text, "\"hi\\nevil: 1\\n#\"");
  const std::string signal =
      replaced(study, "\"hi\\nevil: 1\\n#\"/position", "\"hi\\nevil: 1\\n#/position\"");
  const Problem problem = load_problem(
      {"a.urdf", renamed(plain.urdf().text, "hi&#10;evil: 1&#10;#")}, {},
      {"a.yaml",
       replaced(signal, "\"hi\\nevil: 1\\n#\"/velocity", "\"hi\\nevil: 1\\n#/velocity\"") +
           "hardware: {hold: {namespace: a/b}}\n"});
  const std::string text = gains_yaml(problem, problem.parameters());
  EXPECT_EQ(YAML::Load(text).size(), 1U) << text;
  EXPECT_NE(text.find("which drives \"hi\\nevil: 1\\n#\"\n"), std::string::npos) << text;
}

}  // namespace

}  // namespace codesign
