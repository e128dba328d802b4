// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <condition_variable>
#include <deque>
#include <exception>
#include <mutex>
#include <thread>

#include "engine/evaluation_engine.h"

namespace codesign {

/// Runs evaluations on a fixed number of threads, in the order of the calls.
class ThreadEngine final : public EvaluationEngine {
 public:
  explicit ThreadEngine(int workers);
  ~ThreadEngine() override;
  ThreadEngine(const ThreadEngine&) = delete;
  ThreadEngine& operator=(const ThreadEngine&) = delete;

  /// An exception of a task is thrown again here after the other tasks of the call have ended.
  std::vector<Evaluation> evaluate(const std::vector<EvaluationTask>& tasks, const std::atomic<bool>* cancel) override;
  int workers() const override { return static_cast<int>(threads_.size()); }

 private:
  /// The tasks of one call of evaluate(), which waits until `done` equals their number.
  struct Batch {
    const std::vector<EvaluationTask>& tasks;
    const std::atomic<bool>* cancel;
    std::vector<Evaluation> results;
    std::size_t next = 0, done = 0;
    std::exception_ptr error;
  };
  void work();

  std::mutex mutex_;  // guards all members below, and the counters of batches
  std::condition_variable has_work_, is_done_;
  std::deque<Batch*> batches_;  // batches with tasks that no worker has taken yet
  bool ends_ = false;
  std::vector<std::thread> threads_;
};

}  // namespace codesign
