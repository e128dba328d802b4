// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "description/tuned_parameters.h"

#include <gtest/gtest.h>

#include <limits>

namespace codesign {
namespace {

TEST(TunedParameters, StandInTheOrderOfTheStudy) {
  Study study;
  for (const auto& [name, value] : {std::pair{"a", 1.0}, {"b", 2.0}, {"c", 3.0}}) {
    Parameter& parameter = study.parameters.emplace_back();
    parameter.name = name;
    parameter.value = value;
  }
  study.tuned = {2, 0};
  EXPECT_EQ(start_parameters(study), (std::vector<double>{1.0, 2.0, 3.0}));
  EXPECT_EQ(start_of(study), Eigen::Vector2d(3.0, 1.0));
  EXPECT_EQ(tuned_names(study), (std::vector<std::string>{"c", "a"}));
  EXPECT_EQ(parameters_at(study, Eigen::Vector2d(30.0, 10.0)), (std::vector<double>{10.0, 2.0, 30.0}));
}

TEST(TunedParameters, AreRequiredForASearch) {
  Study study;
  study.file = "study.yaml";
  EXPECT_THROW(require_tuned(study), InputError);
  study.parameters.emplace_back();
  study.tuned = {0};
  EXPECT_NO_THROW(require_tuned(study));
}

TEST(TunedParameters, NeedTwoFiniteBoundsForManyStarts) {
  Parameter parameter;
  parameter.name = "rod";
  parameter.lower = 0.2;
  parameter.upper = 0.4;
  EXPECT_EQ(range_of(parameter), "[0.2, 0.4]");
  EXPECT_FALSE(find_missing_bounds(parameter));
  parameter.upper = std::numeric_limits<double>::infinity();
  const auto fault = find_missing_bounds(parameter);
  ASSERT_TRUE(fault);
  EXPECT_EQ(fault->element, "parameter rod");
}

}  // namespace
}  // namespace codesign
