// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "mechanism_codesign/status.h"

#include <gtest/gtest.h>

#include <set>

namespace codesign {
namespace {

TEST(Status, OnlySuccessIsOk) {
  EXPECT_TRUE(Status().ok());
  EXPECT_FALSE((Status{StatusCode::kCancelled, 0.5, "cancelled"}).ok());
}

TEST(Status, EveryCodeHasANameOfItsOwn) {
  std::set<std::string> names;
  const int last = static_cast<int>(StatusCode::kNonFiniteGradient);
  for (int code = 0; code <= last; ++code) names.insert(name_of(static_cast<StatusCode>(code)));
  EXPECT_EQ(names.size(), static_cast<std::size_t>(last) + 1);
  EXPECT_EQ(names.count("unknown"), 0U);
  EXPECT_STREQ(name_of(StatusCode::kAssemblyFailed), "assembly_failed");
  EXPECT_STREQ(name_of(StatusCode::kInvalidDesign), "invalid_design");
}

}  // namespace
}  // namespace codesign
