// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_ENGINE_RANK_WORKER_H_
#define MECHANISM_CODESIGN_ENGINE_RANK_WORKER_H_

#include <condition_variable>
#include <deque>
#include <map>
#include <mutex>
#include <vector>

#include "engine/messages.h"
#include "engine/poll_pause.h"
#include "engine/transport.h"
#include "engine/worker.h"

namespace codesign {

/// A rank other than 0: compiles the problems that it is sent, and answers their tasks in the order in which they come. One thread
/// computes; the other one, that of the caller, makes all calls of the transport, so that a cancel reaches an evaluation that runs.
class RankWorker {
 public:
  /// @param transport must outlive it.
  explicit RankWorker(Transport* transport, const RankTimes& times = {});

  /// Works until rank 0 ends the job. @returns empty, or a sentence if rank 0 is gone.
  std::string run();

 private:
  using Clock = PollPause::Clock;
  struct Item {
    MessageKind kind;
    std::uint64_t number;
    std::string bytes;
  };
  /// A problem that was sent, compiled.
  struct Known {
    std::vector<std::shared_ptr<const CompiledSystem>> systems;
    EvaluationWorker worker;
    std::exception_ptr error;  ///< why it could not be compiled
  };

  std::string listen();
  bool take(Envelope envelope);
  void cancel_task(std::uint64_t number);
  void compute();
  std::string do_item(const Item& item);
  Evaluation evaluate(const TaskMessage& task);

  Transport* const transport_;
  const RankTimes times_;
  std::map<std::uint32_t, Known> problems_;  // of the computing thread
  std::atomic<bool> cancel_{false};          // ends the task that runs
  std::mutex mutex_;                         // guards all that follows
  std::condition_variable has_items_, has_answer_;
  std::deque<Item> items_;
  std::vector<std::string> answers_;  // that are to be sent
  std::uint64_t running_ = 0;         // number of the task that runs; 0: none
  bool is_computing_ = false, ends_ = false;
};

}  // namespace codesign

#endif  // MECHANISM_CODESIGN_ENGINE_RANK_WORKER_H_
