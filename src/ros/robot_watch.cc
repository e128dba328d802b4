// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "ros/robot_watch.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <thread>
#include <utility>

#include "text/number_text.h"

namespace codesign {
namespace {

using SteadyClock = std::chrono::steady_clock;

double seconds_since(SteadyClock::time_point time) { return std::chrono::duration<double>(SteadyClock::now() - time).count(); }

/// The stamp of a message that is farther in the future does not show the age of the message [s].
constexpr double kFarFuture = 3600.0;

}  // namespace

double age_of(const ros::Time& stamp, const ros::Time& now) {
  const auto difference = static_cast<std::int64_t>(now.toNSec()) - static_cast<std::int64_t>(stamp.toNSec());
  return 1e-9 * static_cast<double>(difference);
}

RobotWatch::RobotWatch(ros::NodeHandle node, SafeRanges ranges, WatchOptions options)
    : ranges_(std::move(ranges)), options_(std::move(options)) {
  const auto hints = ros::TransportHints().tcpNoDelay();
  const std::lock_guard<std::mutex> lock(mutex_);
  if (!options_.joint_states.empty()) {
    last_[options_.joint_states];
    subscribers_.push_back(node.subscribe<sensor_msgs::JointState>(
        options_.joint_states, 100, [this](const sensor_msgs::JointState::ConstPtr& message) { on_joint_states(*message); }, {}, hints));
  }
  for (const std::string& topic : ranges_.topics()) {
    last_[topic];
    subscribers_.push_back(node.subscribe<std_msgs::Float64>(
        topic, 100, [this, topic](const std_msgs::Float64::ConstPtr& message) { on_number(topic, message->data); }, {}, hints));
  }
}

std::string RobotWatch::begin(double patience) {
  const Time start = SteadyClock::now();
  for (;; std::this_thread::sleep_for(std::chrono::milliseconds(5))) {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (is_complete()) break;
    if (alarm_) return alarm_->sentence;
    if (seconds_since(start) > patience) return "nothing came on the topic " + silent_topic() + " within " + to_decimal(patience) + " s";
  }
  const std::lock_guard<std::mutex> lock(mutex_);
  if (options_.joint_states.empty()) return alarm_ ? alarm_->sentence : "";
  for (const std::string& signal : ranges_.joint_signals())
    if (seen_.count(signal) == 0) return "the messages on " + options_.joint_states + " have no " + signal + ", which is to be watched";
  return alarm_ ? alarm_->sentence : "";
}

std::optional<RampAlarm> RobotWatch::alarm() {
  const std::lock_guard<std::mutex> lock(mutex_);
  for (const auto& [topic, last] : last_)
    if (last && seconds_since(*last) > options_.max_age)
      note("no message came on " + topic + " for " + to_decimal(options_.max_age) + " s", SteadyClock::now());
  return alarm_;
}

void RobotWatch::on_joint_states(const sensor_msgs::JointState& message) {
  const Time now = SteadyClock::now();
  const std::lock_guard<std::mutex> lock(mutex_);
  last_[options_.joint_states] = now;
  const double age = message.header.stamp.isZero() ? 0.0 : age_of(message.header.stamp, ros::Time::now());
  if (age > options_.max_age)
    note("the message on " + options_.joint_states + " is " + to_decimal(age) + " s old by its stamp, more than " +
             to_decimal(options_.max_age) + " s",
         now);
  if (age < -kFarFuture)
    note("the message on " + options_.joint_states + " is from the future: its stamp is " + to_decimal(-age) + " s ahead of the clock",
         now);
  const std::pair<const char*, const std::vector<double>*> parts[] = {
      {"/position", &message.position}, {"/velocity", &message.velocity}, {"/effort", &message.effort}};
  for (const auto& [quantity, values] : parts)
    for (std::size_t k = 0; k < std::min(values->size(), message.name.size()); ++k) {
      seen_.insert(message.name[k] + quantity);
      check(message.name[k] + quantity, (*values)[k], now);
    }
  for (std::size_t k = 0; k < std::min(message.position.size(), message.name.size()); ++k)
    check_deviation(message.name[k], message.position[k], now);
}

void RobotWatch::on_number(const std::string& topic, double value) {
  const Time now = SteadyClock::now();
  const std::lock_guard<std::mutex> lock(mutex_);
  last_[topic] = now;
  check(topic, value, now);
}

void RobotWatch::note(const std::string& sentence, Time since) {
  if (!alarm_) alarm_ = RampAlarm{sentence, since};
}

void RobotWatch::check(const std::string& signal, double value, Time since) {
  const std::string sentence = ranges_.check(signal, value);
  if (!sentence.empty()) note(sentence, since);
}

void RobotWatch::check_deviation(const std::string& joint, double position, Time since) {
  if (options_.deviation <= 0.0) return;
  const double first = first_positions_.insert({joint, position}).first->second;
  if (std::abs(position - first) <= options_.deviation) return;
  note(joint + "/position has changed by " + to_decimal(position - first) + " since the beginning, more than " +
           to_decimal(options_.deviation),
       since);
}

std::string RobotWatch::silent_topic() const {
  for (const auto& [topic, last] : last_)
    if (!last) return topic;
  return "";
}

bool RobotWatch::is_complete() const { return silent_topic().empty(); }

}  // namespace codesign
