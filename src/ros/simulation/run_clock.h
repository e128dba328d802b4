// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ros/time.h>

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <functional>
#include <mutex>

namespace codesign {

/// Wakes the thread that waits for commands and requests. Thread-safe.
class Bell {
 public:
  void ring() {
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      ++rung_;
    }
    condition_.notify_all();
  }

  /// Returns once the bell has been rung since the last wait(), or after `seconds`. For one waiting
  /// thread.
  void wait(double seconds) {
    std::unique_lock<std::mutex> lock(mutex_);
    condition_.wait_for(lock, std::chrono::duration<double>(seconds),
                        [this] { return rung_ != heard_; });
    heard_ = rung_;
  }

 private:
  std::mutex mutex_;
  std::condition_variable condition_;
  std::uint64_t rung_ = 0, heard_ = 0;
};

/// Determines when an instant of a run is due, and its stamp.
///
/// Paced: `time_scale` seconds of the run pass in one second, and stamps are in ROS time.
/// Free-running: nothing waits, and stamps are the accumulated time of all runs plus 1 s (ROS takes
/// zero as "no time"), to be published on /clock.
class RunClock {
 public:
  /// @param time_scale seconds of the run per second, above zero; 0 for free-running.
  explicit RunClock(double time_scale) : time_scale_(time_scale) {}

  bool is_free_running() const { return time_scale_ == 0.0; }

  /// Starts a run. @param previous_duration time since the start of the previous run [s]; 0 for the
  /// first run.
  void start_run(double previous_duration);

  /// Whether the stamps of a further run of `duration` [s] can be represented: ROS time ends at
  /// 2^32 s.
  bool has_room_for(double duration) const {
    return !is_free_running() || offset_ + duration < 4.2e9;
  }

  /// Stamp of `time` [s] in this run.
  ros::Time stamp(double time) const;

  /// The time of this run [s] at a stamp, the inverse of stamp().
  double time_of(const ros::Time& stamp) const;

  /// Makes `time` [s] due now: after a pause a paced run does not hurry to catch up.
  void go_on_from(double time);

  /// Waits until `time` [s] of the run is due. Returns false as soon as `stop()` is true.
  bool wait(double time, const std::function<bool()>& stop) const;

 private:
  double time_scale_;
  double offset_ = 1.0;
  ros::Time start_;
  ros::WallTime wall_start_;
};

/// Limits the average rate of frames in wall time, so that subscribers can follow.
class Pace {
 public:
  /// @param limit frames per second of wall time.
  explicit Pace(double limit = 1.0) : interval_(1.0 / limit) {}

  /// Time to wait before the next frame, asked at `now`. A late frame does not shorten later waits.
  ros::WallDuration wait(const ros::WallTime& now) {
    next_ = std::max(next_, now);
    const ros::WallDuration left = next_ - now;
    next_ += interval_;
    return left;
  }

 private:
  ros::WallDuration interval_;
  ros::WallTime next_;
};

/// The real-time factor: seconds of the run per second of wall time [-], without pauses.
class RealTimeFactor {
 public:
  void start(const ros::WallTime& now) {
    *this = RealTimeFactor();
    start_ = last_wall_ = now;
  }

  /// Leaves out a part of the wall time, in which the run was paused.
  void leave_out(const ros::WallDuration& pause) {
    start_ += pause;
    last_wall_ += pause;
  }

  /// Notes that the run has reached `time` [s]. Returns whether value() is new, at most twice a
  /// second.
  bool note(double time, const ros::WallTime& now) {
    const double seconds = (now - last_wall_).toSec();
    if (seconds < 0.5) return false;
    value_ = (time - last_time_) / seconds;
    last_time_ = time;
    last_wall_ = now;
    return true;
  }

  /// The factor over the last half second.
  double value() const { return value_; }

  /// The factor over the run so far. @param time reached by the run [s].
  double mean(double time, const ros::WallTime& now) const {
    return time / std::max((now - start_).toSec(), 1e-9);
  }

 private:
  ros::WallTime start_, last_wall_;
  double last_time_ = 0.0, value_ = 0.0;
};

}  // namespace codesign
