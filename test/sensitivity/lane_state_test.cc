// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "sensitivity/lane_state.h"

#include <gtest/gtest.h>

namespace codesign {
namespace {

TEST(LaneState, EachPartTakesItsValuesAndDirections) {
  Layout layout;
  layout.n = 7;
  layout.m = 3;
  layout.states = 2;
  const IncrementLayout at(layout);
  State<double> values;
  values.resize(layout);
  values.t = 0.5;
  values.q.setConstant(1.0);
  values.s.setConstant(2.0);
  values.v.setConstant(3.0);
  values.z.setConstant(4.0);
  Directions<4> directions(at.size());
  for (int k = 0; k < at.size(); ++k) directions.col(k) << k, 10.0 * k, 100.0 * k, -k;
  State<Lanes<4>> state;
  state.resize(layout);
  load_lanes(at, values, directions, &state);
  EXPECT_EQ(state.t, 0.5);
  const auto expect = [](const VectorX<Lanes<4>>& part, double value, int first) {
    for (Eigen::Index k = 0; k < part.size(); ++k) {
      EXPECT_EQ(part[k].a, value);
      EXPECT_EQ(part[k].v[1], 10.0 * static_cast<double>(first + k));
      EXPECT_EQ(part[k].v[3], -static_cast<double>(first + k));
    }
  };
  expect(state.q, 1.0, at.x());
  expect(state.s, 2.0, at.s());
  expect(state.v, 3.0, at.v());
  expect(state.z, 4.0, at.z());
}

}  // namespace
}  // namespace codesign
