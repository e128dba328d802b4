// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "description/watched_signal.h"

#include <gtest/gtest.h>

namespace codesign {
namespace {

TEST(WatchedSignal, IsAnEqualityIfItsFinalBoundsAreEqual) {
  WatchedSignal watched;
  watched.lower = watched.upper = Quantity(1.0);
  EXPECT_FALSE(is_equality(watched)) << "a path";
  watched.role = WatchedSignal::Role::kFinal;
  EXPECT_TRUE(is_equality(watched));
  watched.upper = Quantity(1.5);
  EXPECT_FALSE(is_equality(watched));
  watched.upper.reset();
  EXPECT_FALSE(is_equality(watched));
}

TEST(WatchedSignal, HasOrderedBounds) {
  WatchedSignal watched;
  watched.upper = Quantity(1.0);
  EXPECT_NO_THROW(require_ordered_bounds(watched, {}));
  watched.lower = Quantity(1.0);
  EXPECT_THROW(require_ordered_bounds(watched, {}), InputError);
  watched.role = WatchedSignal::Role::kFinal;
  EXPECT_NO_THROW(require_ordered_bounds(watched, {}));
  watched.lower = Quantity(1.5);
  EXPECT_THROW(require_ordered_bounds(watched, {}), InputError);
}

}  // namespace
}  // namespace codesign
