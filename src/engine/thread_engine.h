// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <condition_variable>
#include <cstddef>
#include <deque>
#include <exception>
#include <functional>
#include <map>
#include <mutex>
#include <thread>

#include "description/ensemble.h"
#include "engine/evaluation_engine.h"
#include "sensitivity/gradient_check.h"
#include "text/cancel.h"

namespace codesign {

/// Runs one evaluation after another. Keeps the workspace of each system, so that it is allocated
/// only once. Not thread-safe: use one worker per thread.
class EvaluationWorker {
 public:
  Evaluation evaluate(const EvaluationTask& task, const std::atomic<bool>* cancel) {
    // After a cancel, tasks that still wait are not begun.
    if (is_set(cancel)) return cancelled();
    Evaluation result = compute(task.stepped ? task.stepped : task.system, task.parameters,
                                task.derivatives, cancel);
    if (task.finished) task.finished(result);
    return result;
  }
  Evaluation compute(const std::shared_ptr<const CompiledSystem>& system,
                     const std::vector<double>& parameters, Derivatives derivatives,
                     const std::atomic<bool>* cancel) {
    auto place = evaluators_.find(system.get());
    if (place == evaluators_.end())
      place = evaluators_.emplace(system.get(), evaluator_of(system)).first;
    return place->second.evaluate_design(parameters, derivatives, cancel);
  }

 private:
  static Evaluation cancelled() {
    Evaluation evaluation;
    evaluation.status = {StatusCode::kCancelled, 0.0, "cancelled"};
    return evaluation;
  }

  std::map<const CompiledSystem*, Evaluator>
      evaluators_;  // an Evaluator keeps its system alive, so that its address is not reused
};

/// Runs evaluations one after another in the thread of the caller.
class SerialEngine final : public EvaluationEngine {
 public:
  std::vector<Evaluation> evaluate(const std::vector<EvaluationTask>& tasks,
                                   const std::atomic<bool>* cancel) override {
    const std::lock_guard<std::mutex> lock(mutex_);
    std::vector<Evaluation> results;
    results.reserve(tasks.size());
    for (const EvaluationTask& task : tasks) results.push_back(worker_.evaluate(task, cancel));
    return results;
  }
  int workers() const override { return 1; }

 private:
  std::mutex mutex_;
  EvaluationWorker worker_;
};

/// Calls work(k) for k = 0 to count - 1, at most `threads` calls at the same time; the calls begin
/// in the order of k. Meant for work that mostly waits for an engine. With one thread, all calls
/// are made in the thread of the caller, which also helps if the system makes fewer threads. If a
/// call throws, no further call begins, and the exception is thrown again after the running calls
/// have ended.
void side_by_side(std::size_t count, int threads, const std::function<void(std::size_t)>& work);

/// Number of threads of this process that the options of an engine request, at least one. With kMpi
/// each process uses all processors.
int worker_threads(const EngineOptions& engine);

/// Runs evaluations on a fixed number of threads, in the order of the calls.
class ThreadEngine final : public EvaluationEngine {
 public:
  explicit ThreadEngine(int workers);
  ~ThreadEngine() override;
  ThreadEngine(const ThreadEngine&) = delete;
  ThreadEngine& operator=(const ThreadEngine&) = delete;

  /// An exception of a task is thrown again here after the other tasks of the call have ended.
  std::vector<Evaluation> evaluate(const std::vector<EvaluationTask>& tasks,
                                   const std::atomic<bool>* cancel) override;
  int workers() const override { return std::max(1, static_cast<int>(threads_.size())); }
  /// `fewer_workers` if the system has made fewer threads than were asked for. Without any, the
  /// thread of the caller computes.
  Warnings warnings() const override;

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
  int wanted_ = 0;
  SerialEngine alone_;
  std::vector<std::thread> threads_;
};

}  // namespace codesign
