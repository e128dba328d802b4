// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "observation/energy.h"

#include <gtest/gtest.h>

#include <cmath>

#include "equations/compiled.h"
#include "equations/formulas.h"

namespace codesign {
namespace {

TEST(Energy, OfABarThatSwings) {
  // 1 kg at 0.5 m, Iyy = 0.0834 about its centre, at 0.4 rad and 3 rad/s.
  Compiled bar(pendulum(), let_go("{hinge: {position: 0.4, velocity: 3.0}}", "hinge/velocity"));
  ASSERT_TRUE(bar.start().ok());
  bar.equations.formulas().load(bar.state);
  const Energy energy = mechanical_energy(bar.equations);
  EXPECT_NEAR(energy.kinetic, 0.5 * (0.0834 + 0.25) * 9.0, 1e-13);
  EXPECT_NEAR(energy.potential, -9.81 * 0.5 * std::cos(0.4), 1e-13);
  EXPECT_EQ(energy.total(), energy.kinetic + energy.potential);
}

TEST(Energy, GravityMayPointAnywhere) {
  Compiled bar(pendulum(),
               let_go("{hinge: {position: 0.4}}", "hinge/velocity", "gravity: [2.0, 5.0, 0.0]\n"));
  ASSERT_TRUE(bar.start().ok());
  bar.equations.formulas().load(bar.state);
  // A turn about y by 0.4 takes the bar's end, at -z, towards -x.
  EXPECT_NEAR(mechanical_energy(bar.equations).potential, 2.0 * 0.5 * std::sin(0.4), 1e-14);
}

}  // namespace
}  // namespace codesign
