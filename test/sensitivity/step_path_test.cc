// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "sensitivity/step_path.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

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

State<double> numbered_with_turns(double first, double turns) {
  State<double> state = numbered(first);
  state.turns = {turns, 2.0 * turns, 3.0 * turns};
  return state;
}

StepPath path_of(int points, int most) {
  StepPath path(layout(), most);
  for (int k = 0; k < points; ++k)
    path.append(0.25 * k, k % 2 == 0 ? rodas4() : dopri5(), numbered_with_turns(100.0 * k, k),
                100.0 * k + 0.5);
  return path;
}

void expect_point(const StepPath& path, int k) {
  State<double> point;
  point.resize(layout());
  path.point(k, &point);
  const State<double> expected = numbered_with_turns(100.0 * k, k);
  EXPECT_EQ(point.t, expected.t);
  EXPECT_EQ(point.q, expected.q);
  EXPECT_EQ(point.v, expected.v);
  EXPECT_EQ(point.s, expected.s);
  EXPECT_EQ(point.z, expected.z);
  EXPECT_EQ(point.turns, expected.turns);
}

TEST(StepPath, GivesBackWhatItTook) {
  StepPath path = path_of(3, 0);
  ASSERT_EQ(path.size(), 3);
  for (int k : {2, 1, 0}) {
    EXPECT_EQ(path.step_size(k), 0.25 * k);
    EXPECT_EQ(path.next_start(k), 100.0 * k + 0.5);
    EXPECT_EQ(path.kept_before(k), k);
    expect_point(path, k);
  }
  path.clear();
  EXPECT_EQ(path.size(), 0);
}

TEST(StepPath, KeepsTheFewerOfALongPathTheLongerItIs) {
  const StepPath path = path_of(100, 10);
  ASSERT_EQ(path.size(), 100);
  EXPECT_EQ(path.step_size(99), 0.25 * 99);
  for (int k = 0; k < 100; ++k) EXPECT_EQ(path.kept_before(k), k / 16 * 16) << k;
  expect_point(path, 96);
  expect_point(path, 16);
}

TEST(StepPath, TakesPointsThatAreMadeOnceMoreAsFarAsThereIsRoom) {
  StepPath path = path_of(100, 10);
  long made = 0;
  int most = 0;
  for (int k = 99; k >= 0; --k) {
    const int from = path.kept_before(k);
    if (from < k) {
      const int spacing = path.make_room(from, k);
      EXPECT_LE((k - from) / spacing, 10);
      for (int at = from + 1; at <= k; ++at, ++made) {
        if (at != k && (at - from) % spacing != 0) continue;
        path.keep(at, numbered_with_turns(100.0 * at, at));
      }
    }
    ASSERT_EQ(path.kept_before(k), k);
    expect_point(path, k);
    int kept = 0;
    for (int at = 0; at <= k; ++at) kept += path.kept_before(at) == at ? 1 : 0;
    most = std::max(most, kept);
  }
  EXPECT_LE(most, 2 * 10);
  EXPECT_LT(made, 3 * 100);
}

TEST(StepPath, BeginsAnewWithEveryPoint) {
  StepPath path = path_of(100, 10);
  path.clear();
  for (int k = 0; k < 10; ++k)
    path.append(0.25 * k, k % 2 == 0 ? rodas4() : dopri5(), numbered_with_turns(100.0 * k, k),
                100.0 * k + 0.5);
  for (int k = 0; k < 10; ++k) expect_point(path, k);
}

}  // namespace
}  // namespace codesign
