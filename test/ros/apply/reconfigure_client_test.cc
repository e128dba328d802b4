// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "ros/apply/reconfigure_client.h"

#include <gtest/gtest.h>

namespace codesign {
namespace {

TEST(Reconfigure, ValuesGoToAMessageAndBack) {
  const GainValues values = {{"p", {0.1, false}}, {"on", {1.0, true}}, {"off", {0.0, true}}};
  const dynamic_reconfigure::Config config = config_of(values);
  EXPECT_EQ(config.doubles.size(), 1U);
  EXPECT_EQ(config.bools.size(), 2U);
  EXPECT_EQ(values_of(config), values);
}

TEST(Reconfigure, AServerTellsNumbersAndTruthValuesWithLimits) {
  dynamic_reconfigure::ConfigDescription description;
  description.groups.resize(1);
  for (const auto& [name, type] :
       {std::pair{"p", "double"}, std::pair{"on", "bool"}, std::pair{"mode", "int"}}) {
    dynamic_reconfigure::ParamDescription parameter;
    parameter.name = name;
    parameter.type = type;
    description.groups[0].parameters.push_back(parameter);
  }
  dynamic_reconfigure::Config now =
      config_of({{"p", {2.0, false}}, {"on", {1.0, true}}, {"stranger", {3.0, false}}});
  now.ints.resize(1);
  now.ints[0].name = "mode";
  description.min = config_of({{"p", {-1.0, false}}, {"on", {0.0, true}}});
  description.max = config_of({{"p", {5.0, false}}, {"on", {1.0, true}}});
  const GainServerState state = state_of(description, now);
  EXPECT_EQ(state.now, (GainValues{{"p", {2.0, false}}, {"on", {1.0, true}}}));
  EXPECT_EQ(state.lower, (GainValues{{"p", {-1.0, false}}}));
  EXPECT_EQ(state.upper, (GainValues{{"p", {5.0, false}}}));
}

}  // namespace
}  // namespace codesign
