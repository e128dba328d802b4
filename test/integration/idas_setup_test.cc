// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "integration/idas_setup.h"

#include <gtest/gtest.h>

#include "integration/idas_integrator.h"
#include "integration/servo.h"

namespace codesign {
namespace {

TEST(IdasSetup, TheStudysStepsAreThoseOfIdas) {
  const auto system = servo(
      "{integrator: idas, relative_tolerance: 1.0e-6, absolute_tolerance: 1.0e-7, initial_step: "
      "1.0e-5, maximum_step: 1.0e-4}");
  IdasIntegrator integrator(*system);
  ASSERT_TRUE(integrator.start(system->parameters()).ok());
  double previous = 0.0;
  for (int k = 0; k < 40; ++k) {
    ASSERT_TRUE(integrator.advance(0.6).ok());
    EXPECT_LE(integrator.state().t - previous, 1.0001e-4);
    previous = integrator.state().t;
  }
}

}  // namespace
}  // namespace codesign
