// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include "engine/transport.h"

namespace codesign {
namespace {

TEST(PollPause, IsAnEighthOfTheTimeSinceTheLastMessage) {
  using namespace std::chrono_literals;
  PollPause pause;
  const PollPause::Clock::time_point begin = PollPause::Clock::now();
  pause.restart(begin);
  EXPECT_EQ(pause.next(begin, 1ms), 20us) << "not without a pause";
  EXPECT_EQ(pause.next(begin + 1600us, 1ms), 200us);
  EXPECT_EQ(pause.next(begin + 1h, 1ms), 1ms);
  pause.restart(begin + 1h);
  EXPECT_EQ(pause.next(begin + 1h, 1ms), 20us);
}

}  // namespace

}  // namespace codesign
