// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "integration/increment.h"

#include <gtest/gtest.h>

namespace codesign {
namespace {

TEST(Increment, PartsFollowEachOther) {
  Layout layout;
  layout.n = 7;
  layout.m = 3;
  layout.states = 2;
  const IncrementLayout at(layout);
  EXPECT_EQ(at.size(), 9 + 7 + 12 + 1);
  EXPECT_EQ(at.sigma() + at.states, at.psi());

  State<double> y;
  y.resize(layout);
  const VectorX<double> u = VectorX<double>::LinSpaced(at.size(), 0.0, at.size() - 1.0);
  const double factors[] = {3.0, -1.0};
  combine(at, y, factors, {u, u}, &y);
  EXPECT_EQ(y.q[6], 12.0);
  EXPECT_EQ(y.s[0], 14.0);
  EXPECT_EQ(y.v[0], 18.0);
  EXPECT_EQ(y.z[11], 2.0 * (at.psi() - 1));
}

}  // namespace
}  // namespace codesign
