// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "integration/step_controller.h"

#include <gtest/gtest.h>

#include <limits>

namespace codesign {
namespace {

/// The next step after one of size 1 with this error, by a fresh controller of order 4.
double after(double error) {
  double proposal = 0.0;
  StepController(4).accept(1.0, error, &proposal);
  return proposal;
}

TEST(StepController, AcceptsUpToOne) {
  double proposal = 0.0;
  EXPECT_TRUE(StepController(4).accept(1.0, 1.0, &proposal));
  EXPECT_FALSE(StepController(4).accept(1.0, 1.0 + 1e-15, &proposal));
}

TEST(StepController, TheNextStepWouldMeetTheToleranceWithASafetyOfATenth) {
  // The error of a method of order 4 goes with h^4.
  EXPECT_NEAR(after(0.5), 0.9 * std::pow(0.5, -0.25), 1e-15);
  EXPECT_NEAR(after(1.0), 0.9, 1e-15);
  EXPECT_NEAR(after(2.0), 0.9 * std::pow(2.0, -0.25), 1e-15);
}

TEST(StepController, ChangesAreLimited) {
  EXPECT_NEAR(after(0.0), 6.0, 1e-12);
  EXPECT_NEAR(after(1e-30), 6.0, 1e-12);
  EXPECT_NEAR(after(1e30), 0.2, 1e-12);
}

TEST(StepController, AnErrorThatIsNoNumberIsARejection) {
  double proposal = 0.0;
  for (double error : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    EXPECT_FALSE(StepController(4).accept(1.0, error, &proposal));
    EXPECT_EQ(proposal, 0.2);
  }
}

TEST(StepController, NeverGrowsRightAfterARejection) {
  StepController controller(4);
  double proposal = 0.0;
  ASSERT_FALSE(controller.accept(1.0, 3.0, &proposal));
  ASSERT_TRUE(controller.accept(0.5, 1e-6, &proposal));
  EXPECT_EQ(proposal, 0.5);
  ASSERT_TRUE(controller.accept(0.5, 1e-6, &proposal));
  EXPECT_GT(proposal, 0.5) << "only once";
  EXPECT_EQ(controller.back_off(0.5), 0.1);
  ASSERT_TRUE(controller.accept(0.1, 1e-6, &proposal));
  EXPECT_EQ(proposal, 0.1) << "a step that could not be computed counts as rejected";
}

TEST(StepController, AGrowingErrorIsForeseen) {
  // Gustafsson: the error went from 0.1 to 0.5 at the same step, and will go on growing.
  StepController controller(4);
  double proposal = 0.0;
  ASSERT_TRUE(controller.accept(1.0, 0.1, &proposal));
  ASSERT_TRUE(controller.accept(1.0, 0.5, &proposal));
  EXPECT_NEAR(proposal, 0.9 * std::pow(0.5 * 0.5 / 0.1, -0.25), 1e-15);
}

}  // namespace
}  // namespace codesign
