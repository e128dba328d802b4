// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "ros/run_clock.h"

#include <algorithm>

namespace codesign {

void RunClock::start_run(double previous_duration) {
  offset_ += previous_duration;
  if (is_free_running()) return;
  start_ = ros::Time::now();
  wall_start_ = ros::WallTime::now();
}

ros::Time RunClock::stamp(double time) const {
  return is_free_running() ? ros::Time(offset_ + time) : start_ + ros::Duration(time / time_scale_);
}

bool RunClock::wait(double time, const std::function<bool()>& stop) const {
  // Sleeps in short slices, so that `stop` is called often.
  const ros::WallDuration slice(0.1);
  while (!stop()) {
    if (is_free_running()) return true;
    const ros::WallDuration left = wall_start_ + ros::WallDuration(time / time_scale_) - ros::WallTime::now();
    if (left <= ros::WallDuration(0.0)) return true;
    std::min(left, slice).sleep();
  }
  return false;
}

}  // namespace codesign
