// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_ENGINE_POLL_PAUSE_H_
#define MECHANISM_CODESIGN_ENGINE_POLL_PAUSE_H_

#include <algorithm>
#include <chrono>

namespace codesign {

/// How long to sleep before one looks for messages again: MPI has no way to sleep until one arrives, and a process that looks without a
/// pause takes a processor. The pause is an eighth of the time since the last message, so that it delays by at most an eighth of what it
/// waits for, and costs the less, the less there is to do.
class PollPause {
 public:
  using Clock = std::chrono::steady_clock;

  /// A message has arrived.
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
  Duration first_sign = std::chrono::seconds(60);  ///< until a rank says that it is there
  Duration silence = std::chrono::seconds(15);     ///< of a worker, after which it counts as lost
  Duration sign = std::chrono::seconds(3);         ///< how often who has nothing else to say says that it is there
  Duration orphaned = std::chrono::seconds(30);    ///< silence of rank 0, after which a worker ends
  Duration goodbye = std::chrono::seconds(2);      ///< for the answers of all workers to the end of the job
  /// For the answers of all workers to a cancel: mpirun ends a job within a second after one of its ranks was killed.
  Duration answer = std::chrono::milliseconds(300);
};

}  // namespace codesign

#endif  // MECHANISM_CODESIGN_ENGINE_POLL_PAUSE_H_
