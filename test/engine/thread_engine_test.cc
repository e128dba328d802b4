// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <atomic>
#include <chrono>
#include <stdexcept>
#include <thread>
#include <vector>

#include "engine/thread_engine.h"

namespace codesign {
namespace {

TEST(SideBySide, CallsEachNumberOnce) {
  for (int threads : {1, 3, 20}) {
    std::vector<std::atomic<int>> calls(10);
    side_by_side(calls.size(), threads, [&calls](std::size_t k) { ++calls[k]; });
    for (const std::atomic<int>& count : calls) EXPECT_EQ(count, 1);
  }
}

TEST(SideBySide, OneThreadIsTheCallers) {
  side_by_side(2, 1, [caller = std::this_thread::get_id()](std::size_t) {
    EXPECT_EQ(std::this_thread::get_id(), caller);
  });
}

TEST(SideBySide, ThreadsWaitForEachOther) {
  std::atomic<int> arrived{0};
  side_by_side(3, 3, [&arrived](std::size_t) {
    ++arrived;
    while (arrived < 3) std::this_thread::yield();
  });
  EXPECT_EQ(arrived, 3) << "calls that need each other all run at the same time";
}

TEST(SideBySide, AnExceptionEndsTheWork) {
  for (int threads : {1, 2}) {
    std::atomic<int> calls{0};
    const auto work = [&calls](std::size_t k) {
      ++calls;
      if (k == 3) throw std::runtime_error("third");
      // Gives the thread that throws a second to be scheduled; only then could the other one have
      // made all calls.
      if (k > 3) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    };
    EXPECT_THROW(side_by_side(1000, threads, work), std::runtime_error);
    EXPECT_LT(calls, 1000);
  }
}

TEST(WorkerThreads, AreWhatTheEngineSays) {
  EXPECT_EQ(worker_threads({EngineKind::kSerial, 3, {}}), 1);
  EXPECT_EQ(worker_threads({EngineKind::kThreads, 3, {}}), 3);
  EXPECT_GE(worker_threads({EngineKind::kThreads, 0, {}}), 1);
}

}  // namespace

}  // namespace codesign
