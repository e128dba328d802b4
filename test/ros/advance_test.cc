// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "ros/advance.h"

#include <gtest/gtest.h>

#include "mechanism_codesign/simulation.h"
#include "ros/pendulum.h"

namespace codesign {
namespace {

TEST(Advance, AsksOnTheWayAndStops) {
  const Problem problem = pendulum();
  Simulation simulation(problem.system(), problem.parameters());
  ASSERT_TRUE(simulation.start().ok());
  int asked = 0;
  EXPECT_EQ(advance(&simulation, 0.0, 0.5, [&] { return ++asked == 5; }).code, StatusCode::kCancelled);
  EXPECT_EQ(asked, 5);
}

TEST(Advance, ChangesNoStepOfTheRun) {
  const Problem problem = pendulum();
  Simulation sliced(problem.system(), problem.parameters()), whole(problem.system(), problem.parameters());
  Frame from_sliced, from_whole;
  ASSERT_TRUE(sliced.start().ok() && whole.start().ok());
  ASSERT_TRUE(advance(&sliced, 0.0, 0.5, [] { return false; }).ok() && whole.advance(0.5).ok());
  sliced.sample(0.5, &from_sliced);
  whole.sample(0.5, &from_whole);
  EXPECT_EQ(from_sliced.joints[0].position, from_whole.joints[0].position);
  EXPECT_EQ(sliced.statistics().steps, whole.statistics().steps);
}

}  // namespace
}  // namespace codesign
