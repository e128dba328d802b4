// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "ros/progress_log.h"

#include <gtest/gtest.h>

namespace codesign {
namespace {

std::vector<unsigned> kept_of(unsigned count, std::size_t capacity) {
  ProgressLog log(capacity);
  for (unsigned k = 1; k <= count; ++k) {
    mechanism_codesign::OptimizationProgress progress;
    progress.evaluation = k;
    log.add(progress);
    EXPECT_EQ(log.last().evaluation, k);
  }
  std::vector<unsigned> evaluations;
  for (const auto& progress : log.take()) evaluations.push_back(progress.evaluation);
  return evaluations;
}

TEST(ProgressLog, KeepsAllWhileThereIsRoom) { EXPECT_EQ(kept_of(4, 4), (std::vector<unsigned>{1, 2, 3, 4})); }

TEST(ProgressLog, ThinsEvenlyAndKeepsTheLast) {
  EXPECT_EQ(kept_of(5, 4), (std::vector<unsigned>{1, 3, 5}));
  EXPECT_EQ(kept_of(8, 4), (std::vector<unsigned>{1, 3, 5, 7, 8}));
  EXPECT_EQ(kept_of(10, 4), (std::vector<unsigned>{1, 5, 9, 10}));
}

TEST(ProgressLog, StaysWithinItsCapacity) { EXPECT_LE(kept_of(100000, 10).size(), 11U); }

TEST(ProgressLog, MayBeEmpty) { EXPECT_TRUE(kept_of(0, 4).empty()); }

}  // namespace
}  // namespace codesign
