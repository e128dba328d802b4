// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "integration/event_log.h"

#include <gtest/gtest.h>

namespace codesign {
namespace {

TEST(EventLog, KeepsTheFirstEventsAndCountsAll) {
  EventLog log;
  log.start(true);
  const auto memory = log.entries().capacity();
  for (int k = 0; k < 700; ++k) log.add({0.1 * k, nullptr, true, true, k % 2 == 0});
  EXPECT_EQ(log.entries().size(), EventLog::kMost);
  EXPECT_EQ(log.entries().capacity(), memory) << "nothing is allocated in steps";
  EXPECT_EQ(log.count(), 700);
  EXPECT_EQ(log.touched().size(), 20u);
  log.start(true);
  log.touch({});
  EXPECT_EQ(log.touched().size(), 1u);
  log.start(true);
  EXPECT_EQ(log.count(), 0) << "a guard that is only touched is no event";
  EXPECT_TRUE(log.entries().empty() && log.touched().empty());
}

}  // namespace
}  // namespace codesign
