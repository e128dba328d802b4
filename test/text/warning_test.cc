// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "mechanism_codesign/warning.h"

#include <gtest/gtest.h>

namespace codesign {
namespace {

TEST(Warning, ReadsLikeAnErrorAboutTheSamePlace) {
  const InputFault fault{{"arm.urdf", 7}, "<limit>", "lower is above upper, so that nothing is bounded", "1 > -1", "lower <= upper"};
  const Warning warning = warn("limit_order", fault);
  EXPECT_EQ(warning.code, "limit_order");
  EXPECT_EQ(warning.message, InputError(fault).what());
  EXPECT_EQ(warning.where.file, "arm.urdf");
  EXPECT_EQ(warning.where.line, 7);
}

TEST(Warning, IsKeptOnce) {
  Warnings warnings{{"a", "one", {}}};
  append({{"a", "one", {}}, {"a", "two", {}}, {"b", "one", {}}}, &warnings);
  ASSERT_EQ(warnings.size(), 3U);
  EXPECT_EQ(warnings[1].message, "two");
  EXPECT_EQ(warnings[2].code, "b");
}

}  // namespace
}  // namespace codesign
