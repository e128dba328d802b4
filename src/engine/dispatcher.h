// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_ENGINE_DISPATCHER_H_
#define MECHANISM_CODESIGN_ENGINE_DISPATCHER_H_

#include <condition_variable>
#include <deque>
#include <map>
#include <mutex>
#include <thread>
#include <utility>

#include "engine/bytes.h"
#include "engine/messages.h"
#include "engine/rank_batch.h"
#include "engine/transport.h"

namespace codesign {

/// Rank 0 computes as well where there are at most this many ranks: beyond, its processor has enough to do with messages, and what it could
/// compute is a small part of the whole. doc/performance.md has the figures.
constexpr int kMostRanksWithLocal = 32;

/// Rank 0 of a job: hands the tasks of all callers out to the other ranks (RankWorker), in the order in which they came in, and collects
/// the answers. One thread does nothing else and makes all calls of the transport. Thread-safe; used through MpiEngine.
///
/// A rank that is silent for too long, or a connection that fails, ends all batches with StatusCode::kWorkerLost, those to come as well.
/// After a cancel the workers are asked whether they are there: mpirun ends a job by the same signal whether the user interrupts it or one
/// of its ranks has been killed, and that tells the two apart.
class Dispatcher {
 public:
  /// @param transport must outlive it; null for a program that runs alone.
  explicit Dispatcher(Transport* transport, const RankTimes& times = {});
  ~Dispatcher() { finish(); }
  Dispatcher(const Dispatcher&) = delete;
  Dispatcher& operator=(const Dispatcher&) = delete;

  /// Number of processes, with rank 0.
  int ranks() const { return static_cast<int>(ranks_.size()); }
  /// Tells the others that the job is over. @returns whether all of them have heard it.
  bool finish();
  /// Why no task can be done any more; ok as long as all ranks are there.
  Status lost() const;

  /// Whether all ranks have said that they are there. Those that have not yet are neither asked nor given tasks.
  bool is_complete() const;

  /// Asks all ranks whether they are there. @returns kWorkerLost with the first one that does not answer in time, else ok.
  Status call_roll();

  /// Makes a problem known; its texts are sent to each rank with the first task. @returns its number.
  std::uint32_t add(PortableProblem problem);
  void remove(std::uint32_t problem);

  /// Does all tasks of a batch. @param take called with each result that arrives, in this thread.
  /// @returns once the batch is over.
  void run(RankBatch* batch, const std::function<void(std::size_t, Evaluation)>& take);

  /// The next task of a problem, for a thread of rank 0; waits for one. Null once the problem is removed.
  std::pair<RankBatch*, std::size_t> take_local(std::uint32_t problem);
  void give_local(RankBatch* batch, std::size_t index, Evaluation evaluation, const std::exception_ptr& error);

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
  void forget_removed(Outgoing* outgoing);
  void lose(const std::string& sentence);
  void end(RankBatch* batch, const Status& status);
  std::string name_of_rank(int rank) const;

  Transport* const transport_;
  const RankTimes times_;
  mutable std::mutex mutex_;  // guards all that follows but the thread
  std::condition_variable has_work_, has_local_work_, has_pong_;
  std::vector<RankState> ranks_;                   // the first one is rank 0 itself
  std::set<int> free_, half_free_;                 // ranks with no and with one task
  std::map<std::uint32_t, std::string> problems_;  // the messages that carry them
  std::uint32_t next_problem_ = 1;
  std::uint64_t next_number_ = 1, next_ping_ = 1;
  std::deque<RankBatch*> waiting_;  // batches with tasks that nobody has taken
  std::size_t waiting_tasks_ = 0;
  std::vector<RankBatch*> batches_;  // all that are not over
  std::vector<std::uint32_t> forgotten_;
  std::vector<std::uint64_t> roll_calls_;  // pings that are to be sent
  Status lost_;
  bool ends_ = false;
  Clock::time_point looked_ = Clock::now(), watched_ = looked_;
  std::thread thread_;
};

}  // namespace codesign

#endif  // MECHANISM_CODESIGN_ENGINE_DISPATCHER_H_
