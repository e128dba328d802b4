// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "ros/safe_ranges.h"

#include <charconv>
#include <cmath>
#include <limits>

#include "text/number_text.h"

namespace codesign {
namespace {

constexpr double kNone = std::numeric_limits<double>::infinity();
constexpr const char* kRangeForm =
    "SIGNAL=LOW:HIGH with a signal JOINT/position, JOINT/velocity, JOINT/effort or a topic /NAME, and LOW below HIGH";

/// An empty text is `fallback`; NaN if it is no number.
double bound_of(const std::string& text, double fallback) {
  if (text.empty()) return fallback;
  double value = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc() && end == text.data() + text.size() ? value : std::numeric_limits<double>::quiet_NaN();
}

bool is_joint_signal(const std::string& signal) {
  const std::size_t slash = signal.rfind('/');
  if (slash == std::string::npos || slash == 0) return false;
  const std::string quantity = signal.substr(slash + 1);
  return quantity == "position" || quantity == "velocity" || quantity == "effort";
}

}  // namespace

void SafeRanges::add_limits_of(const Problem& problem, const std::vector<double>& parameters) {
  for (const JointDescription& joint : problem.robot().joints) {
    if (!joint.limit) continue;
    const auto symmetric = [&](const char* quantity, const Quantity& bound) {
      const double largest = bound.at(parameters);
      ranges_.insert({joint.name + quantity, {-largest, largest, false}});
    };
    if (has_stops(joint))
      ranges_.insert({joint.name + "/position", {joint.limit->lower.at(parameters), joint.limit->upper.at(parameters), false}});
    if (joint.limit->bounds_velocity()) symmetric("/velocity", joint.limit->velocity);
    if (joint.limit->bounds_effort()) symmetric("/effort", joint.limit->effort);
  }
}

void SafeRanges::add(const std::string& text, const std::string& element) {
  const std::size_t equals = text.find('='), colon = text.find(':', equals == std::string::npos ? 0 : equals);
  const auto fail = [&](const char* message) { throw InputError({{}, element, message, text, kRangeForm}); };
  if (equals == std::string::npos || equals == 0 || colon == std::string::npos) fail("not a range of a signal");
  const std::string signal = text.substr(0, equals);
  const double lower = bound_of(text.substr(equals + 1, colon - equals - 1), -kNone), upper = bound_of(text.substr(colon + 1), kNone);
  if (signal[0] != '/' && !is_joint_signal(signal)) fail("not a signal that can be watched");
  if (!(lower < upper)) fail("not a range");
  ranges_[signal] = {lower, upper, true};
}

std::string SafeRanges::check(const std::string& signal, double value) const {
  const auto found = ranges_.find(signal);
  if (found == ranges_.end()) return "";
  const Range& range = found->second;
  if ((value >= range.lower && value <= range.upper) || (std::isnan(value) && !range.is_given)) return "";
  return signal + " is " + to_decimal(value) + ", outside " + to_decimal(range.lower) + " to " + to_decimal(range.upper) +
         (range.is_given ? "" : ", the limit of the model");
}

std::vector<std::string> SafeRanges::given(bool topics) const {
  std::vector<std::string> signals;
  for (const auto& [signal, range] : ranges_)
    if (range.is_given && (signal[0] == '/') == topics) signals.push_back(signal);
  return signals;
}

}  // namespace codesign
