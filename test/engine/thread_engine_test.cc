// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <pthread.h>
#include <atomic>
#include <memory>
#include <stdexcept>
#include <thread>
#include <vector>

#include "engine/thread_engine.h"
#include "ensemble/ensemble_fixture.h"

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

/// While it lives no thread can be made: its stack would be larger than the memory.
class NoMoreThreads {
 public:
  NoMoreThreads() {
    pthread_getattr_default_np(&before_);
    pthread_attr_t huge = before_;
    pthread_attr_setstacksize(&huge, std::size_t{1} << 46U);
    pthread_setattr_default_np(&huge);
  }
  ~NoMoreThreads() { pthread_setattr_default_np(&before_); }
  NoMoreThreads(const NoMoreThreads&) = delete;
  NoMoreThreads& operator=(const NoMoreThreads&) = delete;

 private:
  pthread_attr_t before_;
};

TEST(SideBySide, WithoutFurtherThreadsTheCallerWorks) {
  std::vector<int> calls(10);
  const NoMoreThreads none;
  side_by_side(calls.size(), 4, [&calls](std::size_t k) { ++calls[k]; });
  EXPECT_EQ(calls, std::vector<int>(10, 1));
}

TEST(ThreadEngine, WithoutFurtherThreadsTheCallerWorksAndAWarningTells) {
  const NoMoreThreads none;
  ThreadEngine engine(4);
  EXPECT_EQ(engine.workers(), 1);
  ASSERT_EQ(engine.warnings().size(), 1U);
  EXPECT_EQ(engine.warnings().front().code, "fewer_workers");
  const Problem problem = block("");
  const std::vector<EvaluationTask> tasks = {
      {system_of(problem), problem.parameters(Eigen::Vector2d(10.0, 3.0)), gradient_if(true)}};
  const Evaluation evaluation = engine.evaluate(tasks, nullptr).front();
  ASSERT_TRUE(evaluation.status.ok());
  EXPECT_EQ(evaluation.gradient, SerialEngine().evaluate(tasks, nullptr).front().gradient);
}

TEST(ThreadEngine, WithItsThreadsItWarnsOfNothing) {
  EXPECT_TRUE(ThreadEngine(2).warnings().empty());
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
