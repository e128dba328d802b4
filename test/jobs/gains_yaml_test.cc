// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "jobs/gains_yaml.h"

#include <gtest/gtest.h>
#include <yaml-cpp/yaml.h>

#include "jobs/tuned_pendulum.h"

namespace codesign {
namespace {

TEST(GainsYaml, WithoutHardwareThereIsNone) { EXPECT_EQ(gains_yaml(pendulum(), pendulum().parameters()), ""); }

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

}  // namespace
}  // namespace codesign
