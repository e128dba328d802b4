// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "ros/simulation/run_clock.h"

namespace codesign {
namespace {

/// Seconds from one instant of ROS time to another. ros::Duration throws beyond 68 years, and
/// stamps of messages may be anything.
double seconds_between(const ros::Time& from, const ros::Time& to) {
  return 1e-9 * static_cast<double>(static_cast<std::int64_t>(to.toNSec()) -
                                    static_cast<std::int64_t>(from.toNSec()));
}

}  // namespace

void RunClock::start_run(double previous_duration) {
  offset_ += previous_duration;
  if (is_free_running()) return;
  start_ = ros::Time::now();
  wall_start_ = ros::WallTime::now();
}

ros::Time RunClock::stamp(double time) const {
  return is_free_running() ? ros::Time(offset_ + time) : start_ + ros::Duration(time / time_scale_);
}

double RunClock::time_of(const ros::Time& stamp) const {
  return is_free_running() ? seconds_between(ros::Time(offset_), stamp)
                           : seconds_between(start_, stamp) * time_scale_;
}

void RunClock::go_on_from(double time) {
  if (is_free_running()) return;
  // A ROS clock that was set back or has no publisher may show less than the time of the run.
  const ros::Time now = ros::Time::now();
  start_ = now.toSec() > time / time_scale_ ? now - ros::Duration(time / time_scale_) : ros::Time();
  wall_start_ = ros::WallTime::now() - ros::WallDuration(time / time_scale_);
}

bool RunClock::wait(double time, const std::function<bool()>& stop) const {
  // Sleeps in short slices, so that `stop` is called often.
  const ros::WallDuration slice(0.1);
  while (!stop()) {
    if (is_free_running()) return true;
    const ros::WallDuration left =
        wall_start_ + ros::WallDuration(time / time_scale_) - ros::WallTime::now();
    if (left <= ros::WallDuration(0.0)) return true;
    std::min(left, slice).sleep();
  }
  return false;
}

}  // namespace codesign
