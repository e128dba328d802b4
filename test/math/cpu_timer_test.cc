// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "math/cpu_timer.h"

#include <gtest/gtest.h>

namespace codesign {
namespace {

TEST(CpuTimer, AdvancesWithWork) {
  const CpuTimer timer;
  volatile double sum = 0.0;
  while (timer.seconds() <= 0.0) sum = sum + 1.0;
  const double first = timer.seconds();
  EXPECT_GT(first, 0.0);
  EXPECT_GE(timer.seconds(), first);
}

}  // namespace
}  // namespace codesign
