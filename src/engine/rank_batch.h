// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_ENGINE_RANK_BATCH_H_
#define MECHANISM_CODESIGN_ENGINE_RANK_BATCH_H_

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

/// The tasks of one call of MpiEngine::evaluate(), which waits until it is over. Guarded by the mutex of the Dispatcher.
struct RankBatch {
  const std::vector<EvaluationTask>& tasks;
  const std::vector<std::uint32_t> systems;  ///< of each task, its place in distinct_systems()
  const std::uint32_t problem;
  const std::atomic<bool>* cancel;

  std::size_t next = 0;  ///< the first task that nobody has taken
  std::size_t done = 0;  ///< tasks with a result, an exception, or none because of `ended`
  /// Answers of workers, by task, that the caller has yet to read: reading is left to the callers, who are many and have time.
  std::vector<std::pair<std::size_t, std::string>> arrived{};
  std::vector<std::pair<std::size_t, Evaluation>> computed{};  ///< by rank 0 itself
  std::exception_ptr error{};
  Status ended{};  ///< not ok: what became of tasks without a result
  /// After a cancel: the ping that every worker must answer before the batch is over, and when it was sent.
  std::optional<std::uint64_t> ping{};
  PollPause::Clock::time_point pinged{};

  std::condition_variable changed{};  ///< told of results, and when the batch is over

  bool is_over() const { return done == tasks.size() && (!ping || !ended.ok()); }
};

/// A task that a worker has been sent.
struct SentTask {
  std::uint64_t number;
  RankBatch* batch;
  std::size_t index;
};

/// What rank 0 knows of another rank.
struct RankState {
  bool is_ready = false;  ///< has said hello
  bool has_left = false;  ///< has said goodbye
  std::string host;
  PollPause::Clock::time_point heard, told;  ///< the last message from it and to it
  std::uint64_t pong = 0;                    ///< the last ping that it has answered
  std::vector<SentTask> sent{};              ///< tasks without an answer, at most two: one it computes, and one that waits there
  std::set<std::uint32_t> problems{};        ///< those it has been sent
};

}  // namespace codesign

#endif  // MECHANISM_CODESIGN_ENGINE_RANK_BATCH_H_
