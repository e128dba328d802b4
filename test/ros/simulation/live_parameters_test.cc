// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "ros/simulation/live_parameters.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace codesign {
namespace {

std::vector<Parameter> two_parameters() {
  std::vector<Parameter> parameters(2);
  parameters[0].name = "length";
  parameters[0].value = 0.5;
  parameters[0].lower = 0.3;
  parameters[0].upper = 0.8;
  parameters[0].unit = "m";
  parameters[1].name = "Kp";
  parameters[1].value = 2.0;
  return parameters;
}

dynamic_reconfigure::Config asking(const std::string& name, double value) {
  dynamic_reconfigure::Config config;
  config.doubles.emplace_back();
  config.doubles.back().name = name;
  config.doubles.back().value = value;
  return config;
}

TEST(LiveParameters, AreDescribedAsNumbersInOneGroupWithBounds) {
  const dynamic_reconfigure::ConfigDescription description = describe_parameters(two_parameters());
  ASSERT_EQ(description.groups.size(), 1U);
  EXPECT_EQ(description.groups[0].id, 0);
  ASSERT_EQ(description.groups[0].parameters.size(), 2U);
  EXPECT_EQ(description.groups[0].parameters[0].type, "double");
  EXPECT_EQ(description.groups[0].parameters[0].description, "length [m]");
  EXPECT_EQ(description.min.doubles[0].value, 0.3);
  EXPECT_EQ(description.max.doubles[0].value, 0.8);
  EXPECT_TRUE(std::isinf(description.max.doubles[1].value));
  EXPECT_EQ(description.dflt.doubles[1].value, 2.0);
  EXPECT_EQ(config_of(two_parameters(), {0.4, 3.0}).doubles[1].value, 3.0);
}

TEST(LiveParameters, ARequestChangesWhatItNamesWithinItsBounds) {
  const auto wanted = [](const dynamic_reconfigure::Config& request) {
    return wanted_parameters(two_parameters(), {0.5, 2.0}, request);
  };
  EXPECT_EQ(wanted(asking("Kp", -7.0)).values, (std::vector<double>{0.5, -7.0}));
  EXPECT_TRUE(wanted(asking("Kp", -7.0)).warnings.empty());
  const WantedParameters bounded = wanted(asking("length", 3.0));
  EXPECT_EQ(bounded.values[0], 0.8);
  ASSERT_EQ(bounded.warnings.size(), 1U);
  EXPECT_EQ(bounded.warnings[0].code, "parameter_bounded");
  dynamic_reconfigure::Config whole;
  whole.ints.emplace_back();
  whole.ints.back().name = "Kp";
  whole.ints.back().value = 4;
  EXPECT_EQ(wanted(whole).values[1], 4.0);
}

TEST(LiveParameters, UnknownNamesAndNumbersThatAreNotFiniteAreLeftOut) {
  dynamic_reconfigure::Config text, truth;
  text.strs.emplace_back();
  text.strs.back().name = "length";
  text.strs.back().value = "0.4";
  truth.bools.emplace_back();
  truth.bools.back().name = "length";
  for (const auto& request :
       {asking("lenght", 0.4), asking("length", std::numeric_limits<double>::quiet_NaN()), text,
        truth}) {
    const WantedParameters wanted = wanted_parameters(two_parameters(), {0.5, 2.0}, request);
    EXPECT_EQ(wanted.values, (std::vector<double>{0.5, 2.0}));
    ASSERT_EQ(wanted.warnings.size(), 1U);
    EXPECT_EQ(wanted.warnings[0].code, "parameter_refused");
    EXPECT_NE(wanted.warnings[0].message.find("length"), std::string::npos);
  }
}

}  // namespace
}  // namespace codesign
