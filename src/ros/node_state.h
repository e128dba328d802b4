// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_ROS_NODE_STATE_H_
#define MECHANISM_CODESIGN_ROS_NODE_STATE_H_

#include <diagnostic_updater/diagnostic_updater.h>
#include <ros/timer.h>

#include <map>
#include <mutex>
#include <set>
#include <string>

#include "mechanism_codesign/warning.h"

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

  /// What is doubtful, which makes the state a warning as long as it stands: each warning once in the log, and as a value beside the
  /// sentence. Those of one group replace those shown for it before.
  void warn(const std::string& group, const Warnings& warnings);

  /// A value shown beside the sentence.
  void show(const std::string& key, const std::string& value);

 private:
  void report(diagnostic_updater::DiagnosticStatusWrapper& status);

  std::mutex mutex_;
  Level level_ = Level::kOk;
  std::string sentence_ = "starting";
  std::map<std::string, std::string> values_;
  std::map<std::string, Warnings> warnings_;  ///< by group
  std::set<std::string> logged_;
  diagnostic_updater::Updater updater_;
  ros::WallTimer timer_;
};

}  // namespace codesign

#endif  // MECHANISM_CODESIGN_ROS_NODE_STATE_H_
