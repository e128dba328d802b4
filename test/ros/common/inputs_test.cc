// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "ros/common/inputs.h"

#include <gtest/gtest.h>
#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <filesystem>

#include "mechanism_codesign/error.h"
#include "paths.h"
#include "problem/load_problem.h"
#include "reading/urdf/pictures.h"
#include "reading/urdf/urdf_reader.h"
#include "ros/common/parameters.h"
#include "ros/pendulum.h"

namespace codesign {
namespace {

TEST(ToYaml, ATreeOfParametersKeepsItsValuesAndTheirTypes) {
  XmlRpc::XmlRpcValue tree;
  tree["duration"] = 2.0;
  tree["tolerance"] = 1.0e-7;
  tree["count"] = 200;
  tree["flag"] = true;
  tree["gains"]["p"] = "${Kp}";
  tree["terms"][0]["signal"] = "crank_joint/velocity - 3: #x";
  tree["terms"][1] = "200";
  tree["none"].setSize(0);
  const YAML::Node yaml = YAML::Load(to_yaml(tree));
  EXPECT_EQ(yaml["duration"].as<double>(), 2.0);
  EXPECT_EQ(yaml["tolerance"].as<double>(), 1.0e-7);
  EXPECT_EQ(yaml["count"].as<int>(), 200);
  EXPECT_TRUE(yaml["flag"].as<bool>());
  EXPECT_EQ(yaml["gains"]["p"].as<std::string>(), "${Kp}");
  EXPECT_EQ(yaml["terms"][0]["signal"].as<std::string>(), "crank_joint/velocity - 3: #x");
  EXPECT_EQ(yaml["terms"][1].Tag(), "!") << "a text that looks like a number must stay a text";
  EXPECT_TRUE(yaml["none"].IsSequence());
  EXPECT_EQ(yaml.size(), 7U);
}

TEST(ToYaml, EveryDigitOfANumberSurvives) {
  XmlRpc::XmlRpcValue tree;
  tree["x"] = 0.1 + 0.2;
  EXPECT_EQ(YAML::Load(to_yaml(tree))["x"].as<double>(), 0.1 + 0.2);
}

// A study after roslaunch and the parameter server: empty mappings are lost.
XmlRpc::XmlRpcValue on_the_server(const YAML::Node& node) {
  XmlRpc::XmlRpcValue value;
  if (node.IsScalar()) return XmlRpc::XmlRpcValue(node.Scalar());
  if (node.IsSequence()) value.setSize(static_cast<int>(node.size()));
  if (node.IsSequence())
    for (std::size_t i = 0; i < node.size(); ++i)
      value[static_cast<int>(i)] = on_the_server(node[i]);
  if (node.IsMap())
    for (const auto& entry : node) {
      XmlRpc::XmlRpcValue child = on_the_server(entry.second);
      if (child.valid()) value[entry.first.Scalar()] = child;
    }
  return value;
}

Inputs as_tree(const std::string& urdf, const std::string& study) {
  Inputs inputs;
  inputs.urdf = {"robot.urdf", urdf};
  inputs.study = {"/optimization/study", to_yaml(on_the_server(YAML::Load(study)))};
  inputs.study_is_tree = true;
  return inputs;
}

TEST(RequireEveryParameter, ATreeThatLostAnEmptyMappingIsRefused) {
  const Inputs inputs = as_tree(kPendulumUrdf, kPendulumStudy);
  const Problem problem = load(inputs);
  EXPECT_EQ(problem.tuned_names(), std::vector<std::string>{"Kp"})
      << "the study says {length: {}}, and that is what is lost";
  try {
    require_every_parameter(inputs, robot_of(problem));
    FAIL() << "accepted";
  } catch (const InputError& error) {
    EXPECT_EQ(error.fault().where.file, "/optimization/study");
    EXPECT_EQ(error.fault().element, "parameters.length");
    EXPECT_NE(error.fault().allowed.find("{tune: true}"), std::string::npos);
  }
}

TEST(RequireEveryParameter, AFileMayLeaveParametersOut) {
  Inputs inputs = as_tree(kPendulumUrdf, kPendulumStudy);
  inputs.study_is_tree = false;
  EXPECT_NO_THROW(require_every_parameter(inputs, robot_of(load(inputs))));
}

TEST(RequireEveryParameter, TheShippedStudiesTuneTheSameAsATree) {
  int studies = 0;
  for (const auto& entry : std::filesystem::directory_iterator(source_dir() + "/config")) {
    const SourceText study = read_source(entry.path().string());
    const SourceText urdf =
        read_source(source_dir() + "/urdf/" + entry.path().stem().string() + ".urdf");
    Inputs tree = as_tree(urdf.text, study.text);
    const std::string overlay =
        source_dir() + "/urdf/overlays/" + entry.path().stem().string() + ".urdf";
    if (std::filesystem::exists(overlay)) tree.overlays.push_back(read_source(overlay));
    const Problem problem = load(tree);
    EXPECT_NO_THROW(require_every_parameter(tree, robot_of(problem))) << entry.path();
    // XML-RPC sorts by name.
    std::vector<std::string> from_file = load_problem(urdf, tree.overlays, study).tuned_names(),
                             from_tree = problem.tuned_names();
    std::sort(from_file.begin(), from_file.end());
    std::sort(from_tree.begin(), from_tree.end());
    EXPECT_EQ(from_tree, from_file) << entry.path();
    ++studies;
  }
  EXPECT_GE(studies, 2);
}

std::string effective(const Problem& problem) {
  return write_tuned_urdf(problem.urdf(), problem.overlays(), problem.parameters());
}

TEST(Description, TheModelDescribesItselfAtItsOwnValues) {
  const Problem problem = pendulum();
  EXPECT_TRUE(
      describes(kPendulumUrdf, problem, effective(problem), with_sticks(effective(problem))));
  EXPECT_TRUE(describes("\n" + effective(problem) + "\n", problem, effective(problem),
                        with_sticks(effective(problem))));
  EXPECT_FALSE(describes("<robot name='pendulum'/>", problem, effective(problem),
                         with_sticks(effective(problem))));
}

TEST(Description, SticksForLinksWithoutVisualDoNotMakeItAnotherMechanism) {
  const Problem problem = pendulum();
  const std::string drawn = with_sticks(effective(problem));
  EXPECT_NE(drawn, effective(problem));
  EXPECT_TRUE(describes(drawn, problem, effective(problem), with_sticks(effective(problem))));
}

TEST(Description, AValueMakesItAnotherMechanism) {
  const Problem problem = with_settings(pendulum(), {{"length", 0.6}});
  EXPECT_FALSE(
      describes(kPendulumUrdf, problem, effective(problem), with_sticks(effective(problem))));
  EXPECT_TRUE(
      describes(effective(problem), problem, effective(problem), with_sticks(effective(problem))));
}

TEST(Description, AnOverlayMakesItAnotherMechanism) {
  const SourceText overlay{
      "overlay.urdf",
      R"(<robot name="pendulum"><joint name="hinge"><dynamics damping="0.1"/></joint></robot>)"};
  const Problem problem =
      load_problem({"pendulum.urdf", kPendulumUrdf}, {overlay}, {"pendulum.yaml", kPendulumStudy});
  EXPECT_FALSE(
      describes(kPendulumUrdf, problem, effective(problem), with_sticks(effective(problem))));
  EXPECT_NE(effective(problem).find("damping=\"0.1\""), std::string::npos);
}

TEST(StudyFolder, IsThatOfTheFileAndEmptyForATree) {
  Inputs inputs;
  inputs.study = {"/home/somebody/studies/study.yaml", ""};
  EXPECT_EQ(study_folder(inputs), "/home/somebody/studies");
  inputs.study_is_tree = true;
  EXPECT_EQ(study_folder(inputs), "");
}

}  // namespace
}  // namespace codesign
