// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "mechanism_codesign/ros/inputs.h"

#include <gtest/gtest.h>
#include <yaml-cpp/yaml.h>

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

}  // namespace
}  // namespace codesign
