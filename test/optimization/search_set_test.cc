// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "optimization/search_set.h"

#include <gtest/gtest.h>

#include "optimization/cart.h"

namespace codesign {
namespace {

Problem cart() {
  return load_problem(cart_urdf(), {},
                      {"cart.yaml",
                       "duration: 0.1\nparameters: {mass: {}}\n"
                       "objective: {terminal: [{signal: slide/position}]}\n"});
}

TEST(SearchSet, CountsTrialsInTheMeterOfTheCaller) {
  const Problem problem = cart();
  const OptimizerOptions options = problem.optimizer_options();
  ProgressMeter meter(options.max_evaluations, nullptr);
  SearchHooks hooks;
  hooks.meter = &meter;
  SearchSet set(problem, options, hooks, nullptr);
  EXPECT_EQ(&set.meter, &meter);
  EXPECT_NE(&SearchSet(problem, options, {}, nullptr).meter, &meter);
  ASSERT_TRUE(set.trial(Trial()));
  EXPECT_EQ(meter.now().done, 1);
}

TEST(SearchSet, EndsByItsCallerOrByTheObserver) {
  const Problem problem = cart();
  const OptimizerOptions options = problem.optimizer_options();
  std::atomic<bool> cancel{false};
  SearchHooks hooks;
  hooks.trial = [](const Trial& trial) { return trial.evaluation < 2; };
  SearchSet set(problem, options, hooks, &cancel);
  set.observer.of(1)(Trial());
  EXPECT_FALSE(set.is_stopped());
  set.observer.of(2)(Trial());
  EXPECT_TRUE(set.is_stopped());
  SearchSet other(problem, options, {}, &cancel);
  EXPECT_FALSE(other.is_stopped());
  cancel = true;
  EXPECT_TRUE(other.is_stopped());
}

}  // namespace
}  // namespace codesign
