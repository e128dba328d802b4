// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_ROS_NODE_STATE_H_
#define MECHANISM_CODESIGN_ROS_NODE_STATE_H_

#include <diagnostic_updater/diagnostic_updater.h>
#include <ros/timer.h>

#include <map>
#include <mutex>
#include <string>

namespace codesign {

/// What a node is doing, as one sentence in its log and once a second on /diagnostics. Safe to call from any thread.
class NodeState {
 public:
  enum class Level {
    kOk = diagnostic_msgs::DiagnosticStatus::OK,
    kWarning = diagnostic_msgs::DiagnosticStatus::WARN,
    kError = diagnostic_msgs::DiagnosticStatus::ERROR
  };

  /// @param subject what the state is of, as it appears in /diagnostics: "simulation".
  explicit NodeState(const std::string& subject);

  void set(Level level, const std::string& sentence);

  /// A value shown beside the sentence.
  void show(const std::string& key, const std::string& value);

 private:
  void report(diagnostic_updater::DiagnosticStatusWrapper& status);

  std::mutex mutex_;
  Level level_ = Level::kOk;
  std::string sentence_ = "starting";
  std::map<std::string, std::string> values_;
  diagnostic_updater::Updater updater_;
  ros::WallTimer timer_;
};

}  // namespace codesign

#endif  // MECHANISM_CODESIGN_ROS_NODE_STATE_H_
