// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_ROS_RUN_CLOCK_H_
#define MECHANISM_CODESIGN_ROS_RUN_CLOCK_H_

#include <ros/time.h>

#include <functional>

namespace codesign {

/// What a run may last in ROS time, whose seconds are 32 bits [s].
inline constexpr double kLongestRun = 2e9;

/// When an instant of a run is due, and which stamp it carries.
///
/// Paced: stamps are those of ROS time, `time_scale` seconds of the run pass in one second. Free-running: nothing waits, and stamps are the
/// time of the runs laid end to end, from 1 s on (zero means "no time" to ROS), to be published as /clock.
class RunClock {
 public:
  /// @param time_scale above zero; 0 for free-running.
  explicit RunClock(double time_scale) : time_scale_(time_scale) {}

  bool is_free_running() const { return time_scale_ == 0.0; }

  /// Begins a run, `previous_duration` [s] after the start of the one before (0: there was none).
  void start_run(double previous_duration);

  /// Whether the stamps of a run of `duration` [s] more can be told: ROS counts 2^32 seconds.
  bool has_room_for(double duration) const { return !is_free_running() || offset_ + duration < 4.2e9; }

  /// Stamp of `time` [s] in this run.
  ros::Time stamp(double time) const;

  /// Waits until `time` is due. Returns false, at once, when `stop` says so.
  bool wait(double time, const std::function<bool()>& stop) const;

 private:
  double time_scale_;
  double offset_ = 1.0;
  ros::Time start_;
  ros::WallTime wall_start_;
};

}  // namespace codesign

#endif  // MECHANISM_CODESIGN_ROS_RUN_CLOCK_H_
