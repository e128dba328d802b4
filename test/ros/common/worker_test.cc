// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "ros/common/worker.h"

#include <gtest/gtest.h>

#include <future>

namespace codesign {
namespace {

TEST(Worker, RefusesASecondJobUntilTheFirstIsDone) {
  std::promise<void> release, done;
  Worker worker;
  EXPECT_FALSE(worker.busy());
  ASSERT_TRUE(worker.try_start([&](const std::atomic<bool>&) { release.get_future().wait(); },
                               [&] { done.set_value(); }));
  EXPECT_TRUE(worker.busy());
  EXPECT_FALSE(worker.try_start([](const std::atomic<bool>&) { FAIL(); }, [] { FAIL(); }));
  release.set_value();
  done.get_future().wait();
  EXPECT_FALSE(worker.busy());
}

TEST(Worker, WhoeverIsToldTheEndMayStartTheNextJobAtOnce) {
  Worker worker;
  for (int i = 0; i < 1000; ++i) {
    std::promise<void> done;
    ASSERT_TRUE(worker.try_start([](const std::atomic<bool>&) {}, [&] { done.set_value(); })) << i;
    done.get_future().wait();
  }
}

/// A job that signals its begin, and ends when it is cancelled.
Worker::Job until_cancelled(std::promise<void>* begun) {
  return [begun](const std::atomic<bool>& cancel) {
    begun->set_value();
    while (!cancel) std::this_thread::yield();
  };
}

TEST(Worker, CancelReachesTheRunningJobOnly) {
  Worker worker;
  EXPECT_FALSE(worker.cancel()) << "there is none";
  std::promise<void> begun, done;
  ASSERT_TRUE(worker.try_start(until_cancelled(&begun), [&] { done.set_value(); }));
  begun.get_future().wait();
  EXPECT_TRUE(worker.cancel());
  EXPECT_FALSE(worker.cancel()) << "it is cancelled already";
  done.get_future().wait();
  std::promise<bool> cancelled;
  ASSERT_TRUE(worker.try_start(
      [&](const std::atomic<bool>& cancel) { cancelled.set_value(cancel); }, [] {}));
  EXPECT_FALSE(cancelled.get_future().get());
}

TEST(Worker, FinishCancelsAndTakesNoFurtherJobs) {
  Worker worker;
  std::promise<void> begun;
  bool done = false;
  ASSERT_TRUE(worker.try_start(until_cancelled(&begun), [&] { done = true; }));
  worker.finish();
  EXPECT_TRUE(done);
  EXPECT_FALSE(worker.try_start([](const std::atomic<bool>&) {}, [] {}));
}

}  // namespace
}  // namespace codesign
