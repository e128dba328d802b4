// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "reading/parameter_table.h"

#include <gtest/gtest.h>

#include <stdexcept>

namespace codesign {
namespace {

TEST(ParameterTable, KnowsWhatItsExpressionsUse) {
  const ParameterTable table({{"a", 2.0, 0.0, 9.0, "", {}},
                              {"b", 3.0, 0.0, 9.0, "", {}},
                              {"sine", 4.0, 0.0, 9.0, "", {}}});
  EXPECT_TRUE(table.used.empty());
  EXPECT_EQ(table.parse("sin(0)")->value(table.values), 0.0);
  EXPECT_TRUE(table.used.empty()) << "a function is no parameter";
  EXPECT_EQ(table.parse("b + b")->value(table.values), 6.0);
  EXPECT_EQ(table.used, std::set<int>{1});
  EXPECT_EQ(table.parse("b*sine")->value(table.values), 12.0);
  EXPECT_EQ(table.used, (std::set<int>{1, 2}));
}

TEST(ParameterTable, RefusesUnknownNames) {
  const ParameterTable table({{"length", 2.0, 0.0, 9.0, "", {}}});
  EXPECT_THROW(table.parse("lenght"), std::invalid_argument);
  EXPECT_THROW(table.parse("length +"), std::invalid_argument);
  EXPECT_TRUE(table.used.empty());
}

}  // namespace
}  // namespace codesign
