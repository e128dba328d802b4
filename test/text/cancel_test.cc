// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "text/cancel.h"

#include <gtest/gtest.h>

namespace codesign {
namespace {

TEST(Cancel, NullNeverCancels) {
  std::atomic<bool> cancel{false};
  EXPECT_FALSE(is_set(nullptr));
  EXPECT_FALSE(is_set(&cancel));
  cancel = true;
  EXPECT_TRUE(is_set(&cancel));
}

}  // namespace
}  // namespace codesign
