// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <condition_variable>
#include <deque>
#include <map>
#include <mutex>
#include <thread>
#include <utility>
#include <vector>

#include "engine/dispatcher.h"
#include "engine/messages.h"
#include "engine/thread_engine.h"
#include "engine/transport.h"

namespace codesign {

/// Runs the evaluations of one problem on all ranks of a job.
class MpiEngine final : public EvaluationEngine {
 public:
  /// @param dispatcher must outlive it.
  MpiEngine(Dispatcher* dispatcher, const Problem& problem);
  ~MpiEngine() override;
  MpiEngine(const MpiEngine&) = delete;
  MpiEngine& operator=(const MpiEngine&) = delete;

  /// @param tasks their systems must belong to the problem. Tasks that a lost rank leaves
  /// unfinished end with kWorkerLost. An exception of a task is thrown again here after the other
  /// tasks of the call have ended.
  std::vector<Evaluation> evaluate(const std::vector<EvaluationTask>& tasks,
                                   const std::atomic<bool>* cancel) override;
  int workers() const override;

 private:
  void compute();

  Dispatcher* const dispatcher_;
  const std::uint32_t problem_;
  std::vector<std::shared_ptr<const CompiledSystem>> systems_;
  std::map<const CompiledSystem*, std::uint32_t> numbers_;
  std::thread local_;
};

/// Runs on every rank other than 0: compiles the problems that arrive, and runs their tasks in the
/// order of arrival. One thread computes; the thread of the caller makes all calls of the
/// transport, so that a cancel reaches a running evaluation.
class RankWorker {
 public:
  /// @param transport must outlive it.
  explicit RankWorker(Transport* transport, const RankTimes& times = {});

  /// Works until rank 0 ends the job. @returns empty, or a sentence if rank 0 is lost.
  std::string run();

 private:
  using Clock = PollPause::Clock;
  struct Item {
    MessageKind kind;
    std::uint64_t number;
    std::string bytes;
  };
  /// A received problem, compiled.
  struct Known {
    std::vector<std::shared_ptr<const CompiledSystem>> systems;
    std::map<std::pair<std::uint32_t, RunSteps>, std::shared_ptr<const CompiledSystem>> stepped;
    EvaluationWorker worker;
    std::exception_ptr error;  ///< why the problem could not be compiled
  };

  std::string listen();
  bool take(Envelope envelope);
  void cancel_task(std::uint64_t number);
  void compute();
  std::string do_item(const Item& item);
  Evaluation evaluate(const TaskMessage& task);

  Transport* const transport_;
  const RankTimes times_;
  std::map<std::uint32_t, Known> problems_;  // used by the computing thread only
  std::atomic<bool> cancel_{false};          // ends the running task
  std::mutex mutex_;                         // guards all members below
  std::condition_variable has_items_, has_answer_;
  std::deque<Item> items_;
  std::vector<std::string> answers_;  // answers to be sent
  std::uint64_t running_ = 0;         // number of the running task; 0: none
  bool is_computing_ = false, ends_ = false;
};

}  // namespace codesign
