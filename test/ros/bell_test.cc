// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "ros/bell.h"

#include <gtest/gtest.h>

#include <thread>

namespace codesign {
namespace {

TEST(Bell, ARingBeforeTheWaitCounts) {
  Bell bell;
  bell.ring();
  bell.wait(1e6);
}

TEST(Bell, ARingFromAnotherThreadEndsTheWait) {
  Bell bell;
  std::thread other([&bell] { bell.ring(); });
  bell.wait(1e6);
  other.join();
}

TEST(Bell, WithoutARingTheWaitEndsByItself) {
  Bell bell;
  bell.wait(0.01);
  bell.ring();
  bell.wait(1e6);
  bell.wait(0.01);
}

}  // namespace
}  // namespace codesign
