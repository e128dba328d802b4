// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <atomic>
#include <memory>
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

/// Tells the end of a thread, which comes after the thread has noted what it has thrown.
struct EndOfThread {
  std::shared_ptr<std::atomic<bool>> flag;
  ~EndOfThread() {
    if (flag) *flag = true;
  }
};

TEST(SideBySide, AnExceptionEndsTheWork) {
  for (int threads : {1, 2}) {
    std::atomic<int> calls{0};
    const auto has_ended = std::make_shared<std::atomic<bool>>(false);
    const auto work = [&](std::size_t k) {
      ++calls;
      thread_local EndOfThread end;
      if (k == 3) {
        end.flag = has_ended;
        throw std::runtime_error("third");
      }
      while (k > 3 && !*has_ended) std::this_thread::yield();
    };
    EXPECT_THROW(side_by_side(1000, threads, work), std::runtime_error);
    EXPECT_LE(calls, threads == 1 ? 4 : 5) << "the other thread was at a call of its own";
  }
}

TEST(WorkerThreads, AreWhatTheEngineSays) {
  EXPECT_EQ(worker_threads({EngineKind::kSerial, 3, {}}), 1);
  EXPECT_EQ(worker_threads({EngineKind::kThreads, 3, {}}), 3);
  EXPECT_GE(worker_threads({EngineKind::kThreads, 0, {}}), 1);
}

}  // namespace

}  // namespace codesign
