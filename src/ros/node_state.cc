// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "mechanism_codesign/ros/node_state.h"

#include <ros/console.h>
#include <ros/node_handle.h>

namespace codesign {

NodeState::NodeState(const std::string& subject) {
  updater_.setHardwareID("none");
  updater_.add(subject, this, &NodeState::report);
  // A wall timer: simulated time may stand still, and the state is wanted most when it does.
  timer_ = ros::NodeHandle().createWallTimer(ros::WallDuration(1.0), [this](const ros::WallTimerEvent&) { updater_.force_update(); });
}

void NodeState::set(Level level, const std::string& sentence) {
  switch (level) {
    case Level::kOk:
      ROS_INFO_STREAM(sentence);
      break;
    case Level::kWarning:
      ROS_WARN_STREAM(sentence);
      break;
    case Level::kError:
      ROS_ERROR_STREAM(sentence);
      break;
  }
  const std::lock_guard<std::mutex> lock(mutex_);
  level_ = level;
  sentence_ = sentence;
}

void NodeState::show(const std::string& key, const std::string& value) {
  const std::lock_guard<std::mutex> lock(mutex_);
  values_[key] = value;
}

void NodeState::report(diagnostic_updater::DiagnosticStatusWrapper& status) {
  const std::lock_guard<std::mutex> lock(mutex_);
  status.summary(static_cast<unsigned char>(level_), sentence_);
  for (const auto& [key, value] : values_) status.add(key, value);
}

}  // namespace codesign
