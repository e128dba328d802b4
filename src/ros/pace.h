// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ros/time.h>

#include <algorithm>

namespace codesign {

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

/// The real-time factor: seconds of the run per second of wall time [-].
class RealTimeFactor {
 public:
  void start(const ros::WallTime& now) { *this = RealTimeFactor(now); }

  /// Notes that the run has reached `time` [s]. Returns whether value() is new, at most twice a second.
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
  double mean(double time, const ros::WallTime& now) const { return time / std::max((now - start_).toSec(), 1e-9); }

  RealTimeFactor() = default;

 private:
  explicit RealTimeFactor(const ros::WallTime& now) : start_(now), last_wall_(now) {}

  ros::WallTime start_, last_wall_;
  double last_time_ = 0.0, value_ = 0.0;
};

}  // namespace codesign
