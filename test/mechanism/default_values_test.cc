// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "mechanism/default_values.h"

#include <gtest/gtest.h>

namespace codesign {
namespace {

TEST(DefaultValues, ComeInTheOrderOfTheParameters) {
  RobotDescription robot;
  EXPECT_TRUE(default_values(robot).empty());
  robot.parameters.resize(2);
  robot.parameters[0].value = 0.5;
  robot.parameters[1].value = -2.0;
  EXPECT_EQ(default_values(robot), (std::vector<double>{0.5, -2.0}));
}

}  // namespace
}  // namespace codesign
