// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ros/time.h>

#include <atomic>

#include "ros/node_arguments.h"

namespace codesign {

/// Limits the time for recording the motion of a job after it was cancelled (half a second, so that a cancel is answered within one) or the
/// node is asked to end (8 s: roslaunch kills a node after 15 s).
class Patience {
 public:
  explicit Patience(const std::atomic<bool>& cancel) : cancel_(cancel) {}

  bool operator()() {
    const ros::WallTime now = ros::WallTime::now();
    // The end of the node cancels the job, too; a bag that is whole is then worth more than a quick answer.
    if (is_ending()) return is_over(true, 8.0, now, &shutdown_);
    return is_over(cancel_, 0.5, now, &cancelled_);
  }

 private:
  static bool is_over(bool told, double seconds, const ros::WallTime& now, ros::WallTime* since) {
    if (!told) return false;
    if (since->isZero()) *since = now;
    return now - *since > ros::WallDuration(seconds);
  }

  const std::atomic<bool>& cancel_;
  ros::WallTime shutdown_, cancelled_;  ///< times of the first calls that saw a shutdown and a cancel
};

}  // namespace codesign
