// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "mechanism_codesign/event.h"

#include <gtest/gtest.h>

namespace codesign {
namespace {

TEST(Event, IsDescribedByElementExpressionDirectionAndKind) {
  EXPECT_EQ(describe({0.5, "loads[0].effort", "slide", "t < 0.5", false, true}),
            "loads[0].effort, \"t < 0.5\", falling, a jump");
  EXPECT_EQ(describe({0.5, "joint \"slide\"", "slide", "touch of the upper stop", true, false}),
            "joint \"slide\", \"touch of the upper stop\", rising, a kink");
}

}  // namespace
}  // namespace codesign
