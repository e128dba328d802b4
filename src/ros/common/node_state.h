// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <diagnostic_updater/diagnostic_updater.h>
#include <ros/timer.h>

#include <map>
#include <mutex>
#include <set>
#include <string>

#include "mechanism_codesign/warning.h"

namespace codesign {

/// The state of a node: one sentence, written to its log and published once a second on
/// /diagnostics. Thread-safe.
class NodeState {
 public:
  enum class Level {
    kOk = diagnostic_msgs::DiagnosticStatus::OK,
    kWarning = diagnostic_msgs::DiagnosticStatus::WARN,
    kError = diagnostic_msgs::DiagnosticStatus::ERROR
  };

  /// @param subject name of the entry in /diagnostics, e.g. "simulation".
  explicit NodeState(const std::string& subject);

  /// Sets and logs the sentence.
  void set(Level level, const std::string& sentence);

  /// Sets the warnings of a group, which replace the group's earlier ones. Each warning is logged
  /// once and shown as a value; while there are any, the level is at least kWarning.
  void warn(const std::string& group, const Warnings& warnings);

  /// Sets a value of the entry in /diagnostics.
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
