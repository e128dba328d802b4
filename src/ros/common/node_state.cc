// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "ros/common/node_state.h"

#include <ros/console.h>
#include <ros/node_handle.h>

#include <algorithm>

namespace codesign {
namespace {

/// Largest number of warnings shown; further warnings are only counted.
constexpr std::size_t kMostShown = 50;

}  // namespace

NodeState::NodeState(const std::string& subject) {
  updater_.setHardwareID("none");
  updater_.add(subject, this, &NodeState::report);
  // A wall timer, since simulated time may stand still and the state must be published then too.
  timer_ = ros::NodeHandle().createWallTimer(
      ros::WallDuration(1.0), [this](const ros::WallTimerEvent&) { updater_.force_update(); });
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

void NodeState::warn(const std::string& group, const Warnings& warnings) {
  const std::lock_guard<std::mutex> lock(mutex_);
  warnings_[group] = warnings;
  for (std::size_t i = 0; i < std::min(warnings.size(), kMostShown); ++i) {
    if (logged_.size() > 1000) logged_.clear();
    if (logged_.insert(warnings[i].message).second) ROS_WARN_STREAM(warnings[i].message);
  }
}

void NodeState::report(diagnostic_updater::DiagnosticStatusWrapper& status) {
  const std::lock_guard<std::mutex> lock(mutex_);
  std::size_t count = 0;
  for (const auto& [group, warnings] : warnings_) {
    for (const Warning& warning : warnings)
      if (++count <= kMostShown)
        status.add("warning " + std::to_string(count) + ": " + warning.code, warning.message);
  }
  const Level level = level_ == Level::kOk && count > 0 ? Level::kWarning : level_;
  const std::string doubts =
      count == 0 ? "" : " (" + std::to_string(count) + (count == 1 ? " warning)" : " warnings)");
  status.summary(static_cast<unsigned char>(level), sentence_ + doubts);
  for (const auto& [key, value] : values_) status.add(key, value);
}

}  // namespace codesign
