// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "optimization/shared_observer.h"

#include <gtest/gtest.h>

#include <vector>

namespace codesign {
namespace {

Trial trial(double objective, double best) {
  Trial t;
  t.evaluation = 7;
  t.objective = objective;
  t.best_objective = best;
  return t;
}

TEST(SharedObserver, NumbersTrialsThroughAndKeepsTheBestOfAll) {
  std::vector<Trial> seen;
  const TrialObserver keep = [&seen](const Trial& t) {
    seen.push_back(t);
    return true;
  };
  SharedObserver shared(keep);
  const TrialObserver first = shared.of(1), second = shared.of(2);
  EXPECT_TRUE(first(trial(3.0, 3.0)));
  EXPECT_TRUE(second(trial(5.0, 5.0)));
  EXPECT_TRUE(second(trial(2.0, 2.0)));
  Trial failed = trial(0.0, 0.0);
  failed.status.code = StatusCode::kNonFinite;
  EXPECT_TRUE(first(failed));
  ASSERT_EQ(seen.size(), 4u);
  for (int k = 0; k < 4; ++k) EXPECT_EQ(seen[static_cast<std::size_t>(k)].evaluation, k + 1);
  EXPECT_EQ(seen[1].best_objective, 3.0);
  EXPECT_EQ(seen[1].start, 2);
  EXPECT_EQ(seen[1].iteration, 0);
  EXPECT_EQ(seen[2].best_objective, 2.0);
  EXPECT_EQ(seen[2].iteration, 1);
  EXPECT_EQ(seen[3].best_objective, 2.0) << "a failed trial has no objective";
}

TEST(SharedObserver, ALesserViolationIsBetterThanALowerObjective) {
  Trial last;
  const TrialObserver keep = [&last](const Trial& t) {
    last = t;
    return true;
  };
  SharedObserver shared(keep);
  Trial outside = trial(0.5, 0.5);
  outside.best_violation = 1.0;
  EXPECT_TRUE(shared.of(1)(outside));
  EXPECT_TRUE(shared.of(2)(trial(3.0, 3.0)));
  EXPECT_EQ(last.best_objective, 3.0);
  EXPECT_EQ(last.best_violation, 0.0);
  EXPECT_EQ(last.iteration, 1);
  EXPECT_TRUE(shared.of(1)(outside));
  EXPECT_EQ(last.best_objective, 3.0);
}

TEST(SharedObserver, OneRefusalEndsAllSearches) {
  int calls = 0;
  const TrialObserver refuse = [&calls](const Trial&) { return ++calls < 2; };
  SharedObserver shared(refuse);
  EXPECT_TRUE(shared.of(1)(trial(1.0, 1.0)));
  EXPECT_FALSE(shared.is_stopped());
  EXPECT_FALSE(shared.of(2)(trial(1.0, 1.0)));
  EXPECT_TRUE(shared.is_stopped());
  EXPECT_FALSE(shared.of(1)(trial(1.0, 1.0)));
  EXPECT_EQ(calls, 2) << "the observer is not asked again";
}

TEST(SharedObserver, WithoutAnObserverNothingStops) {
  const TrialObserver none;
  SharedObserver shared(none);
  EXPECT_TRUE(shared.of(1)(trial(1.0, 1.0)));
}

}  // namespace
}  // namespace codesign
