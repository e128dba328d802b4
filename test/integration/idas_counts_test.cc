// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "integration/idas_counts.h"

#include <gtest/gtest.h>

#include "integration/idas_integrator.h"
#include "integration/servo.h"

namespace codesign {
namespace {

TEST(IdasCounts, StepsAddUpOverRestarts) {
  const auto system = servo("{integrator: idas, relative_tolerance: 1.0e-6, absolute_tolerance: 1.0e-7}");
  IdasIntegrator integrator(*system);
  ASSERT_TRUE(integrator.start(system->parameters()).ok());
  int steps = 0;
  for (; steps < 5; ++steps) ASSERT_TRUE(integrator.advance(0.6).ok());
  EXPECT_EQ(integrator.statistics().steps, 5);
  ASSERT_TRUE(integrator.go_on(integrator.state().t, system->parameters()).ok());
  for (; steps < 9; ++steps) ASSERT_TRUE(integrator.advance(0.6).ok());
  EXPECT_EQ(integrator.statistics().steps, 9);
}

}  // namespace
}  // namespace codesign
