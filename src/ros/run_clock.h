// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ros/time.h>

#include <functional>

namespace codesign {

/// Longest run in ROS time [s], whose seconds have 32 bits.
inline constexpr double kLongestRun = 2e9;

/// Determines when an instant of a run is due, and its stamp.
///
/// Paced: `time_scale` seconds of the run pass in one second, and stamps are in ROS time. Free-running: nothing waits, and stamps are the
/// accumulated time of all runs plus 1 s (ROS takes zero as "no time"), to be published on /clock.
class RunClock {
 public:
  /// @param time_scale seconds of the run per second, above zero; 0 for free-running.
  explicit RunClock(double time_scale) : time_scale_(time_scale) {}

  bool is_free_running() const { return time_scale_ == 0.0; }

  /// Starts a run. @param previous_duration time since the start of the previous run [s]; 0 for the first run.
  void start_run(double previous_duration);

  /// Whether the stamps of a further run of `duration` [s] can be represented: ROS time ends at 2^32 s.
  bool has_room_for(double duration) const { return !is_free_running() || offset_ + duration < 4.2e9; }

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

}  // namespace codesign
