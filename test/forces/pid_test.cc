// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "forces/pid.h"

#include <gtest/gtest.h>

#include <complex>

namespace codesign {
namespace {

TEST(Pid, WeighsErrorIntegralAndRate) {
  const Pid<double> law{2.0, 3.0, 5.0};
  EXPECT_EQ(law.output(0.5, -1.0, 4.0), 1.0 - 3.0 + 20.0);
  EXPECT_EQ(Pid<double>().output(1.0, 1.0, 1.0), 0.0);
}

TEST(Pid, GainsAreItsDerivatives) {
  using C = std::complex<double>;
  const Pid<C> law{C(2.0), C(3.0), C(5.0)};
  const C i(0.0, 1.0);
  EXPECT_EQ(law.output(0.5 + i, -1.0, 4.0).imag(), 2.0);
  EXPECT_EQ(law.output(0.5, -1.0 + i, 4.0).imag(), 3.0);
  EXPECT_EQ(law.output(0.5, -1.0, 4.0 + i).imag(), 5.0);
}

}  // namespace
}  // namespace codesign
