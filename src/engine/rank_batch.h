// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <condition_variable>
#include <cstdint>
#include <exception>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "engine/evaluation_engine.h"
#include "engine/poll_pause.h"

namespace codesign {

/// The tasks of one call of MpiEngine::evaluate(), which waits until all of them have ended. Guarded by the mutex of the Dispatcher.
struct RankBatch {
  const std::vector<EvaluationTask>& tasks;
  const std::vector<std::uint32_t> systems;  ///< per task: index of its system in distinct_systems()
  const std::uint32_t problem;
  const std::atomic<bool>* cancel;

  std::size_t next = 0;  ///< the first task that no rank has taken
  std::size_t done = 0;  ///< number of tasks with a result or an exception, and of tasks that have none because of `ended`
  /// Answers of workers, by task, that the calling thread has yet to parse. Callers parse them, since they wait anyway and may be many.
  std::vector<std::pair<std::size_t, std::string>> arrived{};
  std::vector<std::pair<std::size_t, Evaluation>> computed{};  ///< results that rank 0 has computed itself
  std::exception_ptr error{};
  Status ended{};  ///< not ok: the status of all tasks without a result
  /// After a cancel: the ping that every worker must answer before the batch ends, and the time at which it was sent.
  std::optional<std::uint64_t> ping{};
  PollPause::Clock::time_point pinged{};

  std::condition_variable changed{};  ///< notified of each result and of the end of the batch

  bool is_over() const { return done == tasks.size() && (!ping || !ended.ok()); }
};

/// A task that was sent to a worker.
struct SentTask {
  std::uint64_t number;
  RankBatch* batch;
  std::size_t index;
};

/// What rank 0 knows about another rank.
struct RankState {
  bool is_ready = false;  ///< kHello has arrived
  bool has_left = false;  ///< kGoodbye has arrived
  std::string host;
  PollPause::Clock::time_point heard, told;  ///< time of the last message from this rank and to it
  std::uint64_t pong = 0;                    ///< the last ping that the rank has answered
  std::vector<SentTask> sent{};              ///< tasks without an answer, at most two: one runs, and one waits at the rank
  std::set<std::uint32_t> problems{};        ///< problems that were sent to this rank
};

}  // namespace codesign
