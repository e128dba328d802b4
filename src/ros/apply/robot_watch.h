// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ros/node_handle.h>
#include <ros/time.h>
#include <sensor_msgs/JointState.h>
#include <std_msgs/Float64.h>

#include <chrono>
#include <map>
#include <mutex>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "problem/load_problem.h"
#include "ros/apply/gain_ramp.h"

namespace codesign {

/// Ranges in which signals of a robot must stay: `JOINT/position`, `JOINT/velocity`, `JOINT/effort`
/// of joint states, and topics of numbers, whose names begin with a slash.
class SafeRanges {
 public:
  /// Adds the `<limit>` of every joint: positions of joints with stops, velocities and efforts with
  /// a limit that is not zero.
  /// @param parameters all named parameters.
  void add_limits_of(const Problem& problem, const std::vector<double>& parameters);

  /// Adds a range given as `SIGNAL=LOW:HIGH`; LOW or HIGH may be empty for no limit. The range
  /// replaces the limit of the model.
  /// @throws InputError naming `element` for any other text.
  void add(const std::string& text, const std::string& element);

  /// Why a value is not safe, as a sentence; empty if it is, or if there is no range for the
  /// signal. NaN is unsafe for a range that was given; for a limit of the model it counts as not
  /// measured.
  std::string check(const std::string& signal, double value) const;

  /// Signals of joints with a given range, which the robot must publish; likewise topics.
  std::vector<std::string> joint_signals() const { return given(false); }
  std::vector<std::string> topics() const { return given(true); }

 private:
  struct Range {
    double lower, upper;
    bool is_given;
  };
  std::vector<std::string> given(bool topics) const;

  std::map<std::string, Range> ranges_;
};

struct WatchOptions {
  std::string joint_states = "joint_states";  ///< topic; empty: joint states are not watched
  /// Largest age of the last message of each watched topic, by its arrival and by its stamp [s]. A
  /// stamp more than an hour in the future is an alarm, too.
  double max_age = 0.5;
  /// largest change of a position since the first message [rad or m]; 0: not watched
  double deviation = 0.0;
};

/// Watches a running robot: joint states and topics of numbers must keep coming, and their values
/// must stay in their ranges. Thread-safe.
class RobotWatch {
 public:
  /// Subscribes. @param node whose callback queue is served by another thread.
  RobotWatch(ros::NodeHandle node, SafeRanges ranges, WatchOptions options);

  /// Waits until each topic has sent a message. @return why the robot must not be touched, as a
  /// sentence: a topic is silent, a joint with a range is not in the joint states, a value is
  /// outside its range; empty: nothing is wrong.
  std::string begin(double patience);

  /// The first alarm, with the arrival time of its message; empty if there is none so far.
  std::optional<RampAlarm> alarm();

 private:
  using Time = std::chrono::steady_clock::time_point;

  void on_joint_states(const sensor_msgs::JointState& message);
  void on_number(const std::string& topic, double value);
  /// Keeps the first alarm. Called with mutex_ locked.
  void note(const std::string& sentence, Time since);
  void check(const std::string& signal, double value, Time since);
  void check_deviation(const std::string& joint, double position, Time since);
  std::string silent_topic() const;
  bool is_complete() const;

  const SafeRanges ranges_;
  const WatchOptions options_;
  std::mutex mutex_;
  std::map<std::string, std::optional<Time>> last_;  ///< arrival of the last message, by topic
  std::map<std::string, double> first_positions_;
  std::set<std::string> seen_;  ///< signals of joint states
  std::optional<RampAlarm> alarm_;
  std::vector<ros::Subscriber> subscribers_;  // last: callbacks use all of the above
};

/// Now minus the stamp [s], for any two times; the difference of ros::Time throws beyond 68 years.
double age_of(const ros::Time& stamp, const ros::Time& now);

}  // namespace codesign
