// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_ROS_PACE_H_
#define MECHANISM_CODESIGN_ROS_PACE_H_

#include <ros/time.h>

#include <algorithm>

namespace codesign {

/// Keeps frames at least an interval of wall time apart on the average, so that whoever listens can follow.
class Pace {
 public:
  /// @param limit frames per second.
  explicit Pace(double limit = 1.0) : interval_(1.0 / limit) {}

  /// How long to wait before a frame at `now`. A frame that comes late is not made up for.
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

/// Seconds of the run in one second of wall time.
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

  /// Over the last half second.
  double value() const { return value_; }

  /// Over the run so far.
  double mean(double time, const ros::WallTime& now) const { return time / std::max((now - start_).toSec(), 1e-9); }

  RealTimeFactor() = default;

 private:
  explicit RealTimeFactor(const ros::WallTime& now) : start_(now), last_wall_(now) {}

  ros::WallTime start_, last_wall_;
  double last_time_ = 0.0, value_ = 0.0;
};

}  // namespace codesign

#endif  // MECHANISM_CODESIGN_ROS_PACE_H_
