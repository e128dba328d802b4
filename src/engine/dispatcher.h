// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <condition_variable>
#include <cstdint>
#include <deque>
#include <exception>
#include <map>
#include <mutex>
#include <optional>
#include <set>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "engine/bytes.h"
#include "engine/evaluation_engine.h"
#include "engine/messages.h"
#include "engine/transport.h"

namespace codesign {

/// The tasks of one call of MpiEngine::evaluate(), which waits until all of them have ended.
/// Guarded by the mutex of the Dispatcher.
struct RankBatch {
  const std::vector<EvaluationTask>& tasks;
  /// per task: index of its system in distinct_systems()
  const std::vector<std::uint32_t> systems;
  const std::uint32_t problem;
  const std::atomic<bool>* cancel;

  std::size_t next = 0;  ///< the first task that no rank has taken
  /// number of tasks with a result or an exception, and of tasks that have none because of `ended`
  std::size_t done = 0;
  /// Answers of workers, by task, that the calling thread has yet to parse. Callers parse them,
  /// since they wait anyway and may be many.
  std::vector<std::pair<std::size_t, std::string>> arrived{};
  /// results that rank 0 has computed itself
  std::vector<std::pair<std::size_t, Evaluation>> computed{};
  std::exception_ptr error{};
  Status ended{};  ///< not ok: the status of all tasks without a result
  /// After a cancel: the ping that every worker must answer before the batch ends, and the time at
  /// which it was sent.
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
  /// time of the last message from this rank and to it
  PollPause::Clock::time_point heard, addressed;
  std::uint64_t pong = 0;  ///< the last ping that the rank has answered
  /// tasks without an answer, at most two: one runs, and one waits at the rank
  std::vector<SentTask> sent{};
  std::set<std::uint32_t> problems{};  ///< problems that were sent to this rank
};

/// Rank 0 evaluates tasks itself, too, if the job has at most this many ranks. In a larger job its
/// processor is busy with messages, and its share of the evaluations would be small.
/// doc/performance.md has the figures.
constexpr int kMostRanksWithLocal = 32;

/// Runs on rank 0 of a job: sends the tasks of all callers to the other ranks (RankWorker), in the
/// order of their arrival, and collects the answers. A thread of its own makes all calls of the
/// transport. Thread-safe; used through MpiEngine.
///
/// If a rank is silent for too long or a connection fails, all batches end with
/// StatusCode::kWorkerLost, and so do all later batches. After a cancel the dispatcher pings all
/// workers: mpirun sends the same signal when the user interrupts the job and when one of its ranks
/// was killed, and a missing answer distinguishes the two cases.
class Dispatcher {
 public:
  /// @param transport must outlive it; null for a program that runs alone.
  explicit Dispatcher(Transport* transport, const RankTimes& times = {});
  ~Dispatcher() { finish(); }
  Dispatcher(const Dispatcher&) = delete;
  Dispatcher& operator=(const Dispatcher&) = delete;

  /// Number of processes, rank 0 included.
  int ranks() const { return static_cast<int>(ranks_.size()); }
  /// Sends the end of the job to all other ranks. @returns whether all of them have answered.
  bool finish();
  /// The reason why no further task can run; ok as long as no rank is lost.
  Status lost() const;

  /// Whether every rank has sent its first message. A rank gets neither pings nor tasks before it
  /// has.
  bool is_complete() const;

  /// Pings all ranks. @returns kWorkerLost naming the first rank that does not answer in time, else
  /// ok.
  Status call_roll();

  /// Adds a problem; its texts are sent to each rank with the first task of the problem. @returns
  /// the number of the problem.
  std::uint32_t add(PortableProblem problem);
  void remove(std::uint32_t problem);

  /// Runs all tasks of a batch. @param take called with each result that arrives, in the thread of
  /// the caller.
  /// @returns when the batch has ended.
  void run(RankBatch* batch, const std::function<void(std::size_t, Evaluation)>& take);

  /// Waits for the next task of a problem that rank 0 evaluates itself. @returns a null batch once
  /// the problem is removed.
  std::pair<RankBatch*, std::size_t> take_local(std::uint32_t problem);
  void give_local(RankBatch* batch, std::size_t index, Evaluation evaluation,
                  const std::exception_ptr& error);

 private:
  using Clock = PollPause::Clock;
  using Outgoing = std::vector<std::pair<int, std::string>>;

  void work();
  void say_goodbye();
  void handle(Envelope envelope, Clock::time_point now);
  void welcome(int rank, ByteReader* reader);
  void take_answer(int rank, std::uint64_t number, std::string bytes);
  void hand_out(Outgoing* outgoing);
  void send_next(int rank, Outgoing* outgoing);
  std::pair<RankBatch*, std::size_t> take_next(std::deque<RankBatch*>::iterator batch);
  void watch_cancels(Clock::time_point now, Outgoing* outgoing);
  void end_tasks(RankBatch* batch, Clock::time_point now, Outgoing* outgoing);
  void ping_all(std::uint64_t ping, Outgoing* outgoing) const;
  Status missed_since(std::uint64_t ping) const;
  void drop_waiting(RankBatch* batch);
  void sort_in(int rank);
  void watch_ranks(Clock::time_point now, Outgoing* outgoing);
  void send_removals(Outgoing* outgoing);
  void lose(const std::string& sentence);
  void end(RankBatch* batch, const Status& status);
  std::string name_of_rank(int rank) const;

  Transport* const transport_;
  const RankTimes times_;
  mutable std::mutex mutex_;  // guards all members below except the thread
  std::condition_variable has_work_, has_local_work_, has_pong_;
  std::vector<RankState> ranks_;                   // the first one is rank 0 itself
  std::set<int> free_, half_free_;                 // ranks with no and with one task
  std::map<std::uint32_t, std::string> problems_;  // the message with each problem, by its number
  std::uint32_t next_problem_ = 1;
  std::uint64_t next_number_ = 1, next_ping_ = 1;
  std::deque<RankBatch*> waiting_;  // batches with tasks that no rank has taken
  std::size_t waiting_tasks_ = 0;
  std::vector<RankBatch*> batches_;  // all batches that have not ended
  std::vector<std::uint32_t> removed_;
  std::vector<std::uint64_t> roll_calls_;  // pings to be sent
  Status lost_;
  bool ends_ = false;
  Clock::time_point looked_ = times_.now(), watched_ = looked_;
  std::thread thread_;
};

}  // namespace codesign
