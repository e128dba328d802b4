// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "integration/step_points.h"

#include <gtest/gtest.h>

namespace codesign {
namespace {

TEST(StepPoints, AreThoseOfTheStudyAndALeastNumber) {
  EXPECT_EQ(step_parts(1e-6, 5, 1024), 5);
  EXPECT_EQ(step_parts(0.5, 5, 1024), 512);
  EXPECT_EQ(step_parts(3.0, 5, 1024), 1024) << "a run that goes on beyond its study";
}

TEST(StepPoints, OneTurnIsShownAndManyNeedMoreParts) {
  EXPECT_TRUE(show_turns(4, 1));
  EXPECT_FALSE(show_turns(15, 2));
  EXPECT_TRUE(show_turns(16, 2));
}

}  // namespace
}  // namespace codesign
