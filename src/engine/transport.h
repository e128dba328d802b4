// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <chrono>
#include <functional>
#include <optional>
#include <string>

namespace codesign {

/// The pause between two polls for messages. MPI cannot sleep until a message arrives, and polling
/// without a pause would occupy a processor. The pause is an eighth of the time since the last
/// message: it delays a message by at most an eighth of the wait, and an idle process polls rarely.
class PollPause {
 public:
  using Clock = std::chrono::steady_clock;

  /// Call it when a message has arrived.
  void restart(Clock::time_point now) { since_ = now; }
  Clock::duration next(Clock::time_point now, Clock::duration most) const {
    return std::clamp<Clock::duration>((now - since_) / 8, std::chrono::microseconds(20), most);
  }

 private:
  Clock::time_point since_ = Clock::now();
};

/// How long the ranks of a job wait for each other.
struct RankTimes {
  using Duration = PollPause::Clock::duration;
  Duration first_sign = std::chrono::seconds(60);  ///< limit for the first message of a rank
  Duration silence = std::chrono::seconds(15);     ///< silence after which a worker counts as lost
  /// period of signs of life while there is no other message to send
  Duration sign = std::chrono::seconds(3);
  Duration orphaned = std::chrono::seconds(30);  ///< silence of rank 0, after which a worker ends
  /// limit for the answers of all workers to the end of the job
  Duration goodbye = std::chrono::seconds(2);
  /// Limit for the answers of all workers to the ping after a cancel. It is short, since mpirun
  /// ends a job within a second after one of its ranks was killed; run_on_ranks() extends it where
  /// mpirun is told to wait longer.
  Duration answer = std::chrono::milliseconds(300);
  /// the clock of all of them
  std::function<PollPause::Clock::time_point()> now = PollPause::Clock::now;
};

/// A message with the rank it comes from.
struct Envelope {
  int from = 0;
  std::string bytes;
};

/// Carries messages between the processes (ranks) of a job. Messages from one rank to another
/// arrive whole and in the order in which they were sent. No call waits for another process. Called
/// by one thread at a time.
class Transport {
 public:
  virtual ~Transport() = default;
  virtual int rank() const = 0;
  virtual int ranks() const = 0;
  virtual void send(int to, std::string bytes) = 0;
  /// The next message, if one has arrived. Also advances the messages that are being sent.
  virtual std::optional<Envelope> receive() = 0;
  /// A sentence about a failed connection; empty if no connection has failed.
  virtual std::string failure() const = 0;
};

}  // namespace codesign
