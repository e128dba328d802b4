// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ros/node_handle.h>

#include <string>
#include <vector>

#include "mechanism_codesign/frame.h"

namespace codesign {

/// The numbers of a frame that have topics of their own.
struct FrameNumbers {
  std::vector<std::string> topics;                          ///< without `signals/`, legal and all different
  std::vector<double (*)(const Frame&, std::size_t)> read;  ///< per topic
  std::vector<std::size_t> index;                           ///< its second argument

  explicit FrameNumbers(const FrameNames& names);
  double value(const Frame& frame, std::size_t k) const { return read[k](frame, index[k]); }
};

/// Publishes each number of a frame on a topic of its own: `signals/hinge/position`, std_msgs/Float64; doc/ros_api.md.
class FloatTopics {
 public:
  /// @param queue messages kept for each slow subscriber.
  FloatTopics(ros::NodeHandle node, const FrameNames& names, std::uint32_t queue);
  void publish(const Frame& frame) const;

 private:
  FrameNumbers numbers_;
  std::vector<ros::Publisher> publishers_;
};

}  // namespace codesign
