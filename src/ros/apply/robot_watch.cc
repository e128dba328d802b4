// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "ros/apply/robot_watch.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <limits>
#include <thread>
#include <utility>

#include "problem/load_problem.h"
#include "text/number_text.h"

namespace codesign {
namespace {

constexpr double kNone = std::numeric_limits<double>::infinity();
constexpr const char* kRangeForm =
    "SIGNAL=LOW:HIGH with a signal JOINT/position, JOINT/velocity, JOINT/effort or a topic /NAME, "
    "and LOW below HIGH";

/// An empty text is `fallback`; NaN if it is no number.
double bound_of(const std::string& text, double fallback) {
  if (text.empty()) return fallback;
  double value = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc() && end == text.data() + text.size()
             ? value
             : std::numeric_limits<double>::quiet_NaN();
}

bool is_joint_signal(const std::string& signal) {
  const std::size_t slash = signal.rfind('/');
  if (slash == std::string::npos || slash == 0) return false;
  const std::string quantity = signal.substr(slash + 1);
  return quantity == "position" || quantity == "velocity" || quantity == "effort";
}

using SteadyClock = std::chrono::steady_clock;

double seconds_since(SteadyClock::time_point time) {
  return std::chrono::duration<double>(SteadyClock::now() - time).count();
}

/// The stamp of a message that is farther in the future does not show the age of the message [s].
constexpr double kFarFuture = 3600.0;

}  // namespace

void SafeRanges::add_limits_of(const Problem& problem, const std::vector<double>& parameters) {
  for (const JointDescription& joint : robot_of(problem).joints) {
    if (!joint.limit) continue;
    const auto symmetric = [&](const char* quantity, const Quantity& bound) {
      const double largest = bound.at(parameters);
      ranges_.insert({joint.name + quantity, {-largest, largest, false}});
    };
    if (has_stops(joint))
      ranges_.insert(
          {joint.name + "/position",
           {joint.limit->lower.at(parameters), joint.limit->upper.at(parameters), false}});
    if (joint.limit->bounds_velocity()) symmetric("/velocity", joint.limit->velocity);
    if (joint.limit->bounds_effort()) symmetric("/effort", joint.limit->effort);
  }
}

void SafeRanges::add(const std::string& text, const std::string& element) {
  const std::size_t equals = text.find('='),
                    colon = text.find(':', equals == std::string::npos ? 0 : equals);
  const auto fail = [&](const char* message) {
    throw InputError({{}, element, message, text, kRangeForm});
  };
  if (equals == std::string::npos || equals == 0 || colon == std::string::npos)
    fail("not a range of a signal");
  const std::string signal = text.substr(0, equals);
  const double lower = bound_of(text.substr(equals + 1, colon - equals - 1), -kNone),
               upper = bound_of(text.substr(colon + 1), kNone);
  if (signal[0] != '/' && !is_joint_signal(signal)) fail("not a signal that can be watched");
  if (!(lower < upper)) fail("not a range");
  ranges_[signal] = {lower, upper, true};
}

std::string SafeRanges::check(const std::string& signal, double value) const {
  const auto found = ranges_.find(signal);
  if (found == ranges_.end()) return "";
  const Range& range = found->second;
  if ((value >= range.lower && value <= range.upper) || (std::isnan(value) && !range.is_given))
    return "";
  return signal + " is " + to_decimal(value) + ", outside " + to_decimal(range.lower) + " to " +
         to_decimal(range.upper) + (range.is_given ? "" : ", the limit of the model");
}

std::vector<std::string> SafeRanges::given(bool topics) const {
  std::vector<std::string> signals;
  for (const auto& [signal, range] : ranges_)
    if (range.is_given && (signal[0] == '/') == topics) signals.push_back(signal);
  return signals;
}

double age_of(const ros::Time& stamp, const ros::Time& now) {
  const auto difference =
      static_cast<std::int64_t>(now.toNSec()) - static_cast<std::int64_t>(stamp.toNSec());
  return 1e-9 * static_cast<double>(difference);
}

RobotWatch::RobotWatch(ros::NodeHandle node, SafeRanges ranges, WatchOptions options)
    : ranges_(std::move(ranges)), options_(std::move(options)) {
  const auto hints = ros::TransportHints().tcpNoDelay();
  const std::lock_guard<std::mutex> lock(mutex_);
  if (!options_.joint_states.empty()) {
    last_[options_.joint_states];
    subscribers_.push_back(node.subscribe<sensor_msgs::JointState>(
        options_.joint_states, 100,
        [this](const sensor_msgs::JointState::ConstPtr& message) { on_joint_states(*message); }, {},
        hints));
  }
  for (const std::string& topic : ranges_.topics()) {
    last_[topic];
    subscribers_.push_back(node.subscribe<std_msgs::Float64>(
        topic, 100,
        [this, topic](const std_msgs::Float64::ConstPtr& message) {
          on_number(topic, message->data);
        },
        {}, hints));
  }
}

std::string RobotWatch::begin(double patience) {
  const Time start = SteadyClock::now();
  for (;; std::this_thread::sleep_for(std::chrono::milliseconds(5))) {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (is_complete()) break;
    if (alarm_) return alarm_->sentence;
    if (seconds_since(start) > patience)
      return "nothing came on the topic " + silent_topic() + " within " + to_decimal(patience) +
             " s";
  }
  const std::lock_guard<std::mutex> lock(mutex_);
  if (options_.joint_states.empty()) return alarm_ ? alarm_->sentence : "";
  for (const std::string& signal : ranges_.joint_signals())
    if (seen_.count(signal) == 0)
      return "the messages on " + options_.joint_states + " have no " + signal +
             ", which is to be watched";
  return alarm_ ? alarm_->sentence : "";
}

std::optional<RampAlarm> RobotWatch::alarm() {
  const std::lock_guard<std::mutex> lock(mutex_);
  for (const auto& [topic, last] : last_)
    if (last && seconds_since(*last) > options_.max_age)
      note("no message came on " + topic + " for " + to_decimal(options_.max_age) + " s",
           SteadyClock::now());
  return alarm_;
}

void RobotWatch::on_joint_states(const sensor_msgs::JointState& message) {
  const Time now = SteadyClock::now();
  const std::lock_guard<std::mutex> lock(mutex_);
  last_[options_.joint_states] = now;
  const double age =
      message.header.stamp.isZero() ? 0.0 : age_of(message.header.stamp, ros::Time::now());
  if (age > options_.max_age)
    note("the message on " + options_.joint_states + " is " + to_decimal(age) +
             " s old by its stamp, more than " + to_decimal(options_.max_age) + " s",
         now);
  if (age < -kFarFuture)
    note("the message on " + options_.joint_states + " is from the future: its stamp is " +
             to_decimal(-age) + " s ahead of the clock",
         now);
  const std::pair<const char*, const std::vector<double>*> parts[] = {
      {"/position", &message.position},
      {"/velocity", &message.velocity},
      {"/effort", &message.effort}};
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
  note(joint + "/position has changed by " + to_decimal(position - first) +
           " since the beginning, more than " + to_decimal(options_.deviation),
       since);
}

std::string RobotWatch::silent_topic() const {
  for (const auto& [topic, last] : last_)
    if (!last) return topic;
  return "";
}

bool RobotWatch::is_complete() const { return silent_topic().empty(); }

}  // namespace codesign
