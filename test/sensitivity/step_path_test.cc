// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "sensitivity/step_path.h"

#include <gtest/gtest.h>

namespace codesign {
namespace {

Layout layout() {
  Layout layout;
  layout.bodies = 1;
  layout.n = 7;
  layout.m = 6;
  layout.states = 2;
  return layout;
}

State<double> numbered(double first) {
  State<double> state;
  state.resize(layout());
  state.t = first;
  for (VectorX<double>* part : {&state.q, &state.v, &state.s, &state.z})
    for (Eigen::Index k = 0; k < part->size(); ++k) (*part)[k] = first += 1.0;
  return state;
}

TEST(StepPath, GivesBackWhatItTook) {
  StepPath path(layout());
  path.append(0.0, numbered(0.5));
  path.append(0.25, numbered(100.5));
  ASSERT_EQ(path.size(), 2);
  EXPECT_EQ(path.step_size(1), 0.25);
  State<double> state;
  state.resize(layout());
  for (int k : {1, 0}) {
    path.point(k, &state);
    const State<double> expected = numbered(k == 0 ? 0.5 : 100.5);
    EXPECT_EQ(state.t, expected.t);
    EXPECT_EQ(state.q, expected.q);
    EXPECT_EQ(state.v, expected.v);
    EXPECT_EQ(state.s, expected.s);
    EXPECT_EQ(state.z, expected.z);
  }
  path.clear();
  EXPECT_EQ(path.size(), 0);
}

}  // namespace
}  // namespace codesign
