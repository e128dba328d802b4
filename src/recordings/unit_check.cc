// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "recordings/unit_check.h"

#include <algorithm>
#include <cmath>

#include "text/number_text.h"

namespace codesign {
namespace {

// Difference quotients are taken over this many samples on each side, so that the steps of an encoder do not hide the motion.
constexpr std::size_t kSpan = 5;
constexpr double kProportional = 0.9;

/// The relation of a measured velocity to the difference quotients of the position: factor of proportion and correlation.
struct Proportion {
  double factor = 1.0, correlation = 0.0;
};

double quotient(const std::vector<double>& times, const std::vector<double>& position, std::size_t k) {
  return (position[k + kSpan] - position[k - kSpan]) / (times[k + kSpan] - times[k - kSpan]);
}

Proportion by_differences(const std::vector<double>& times, const std::vector<double>& position, const std::vector<double>& velocity) {
  double dd = 0.0, vd = 0.0, vv = 0.0;
  for (std::size_t k = kSpan; k + kSpan < times.size(); ++k) {
    const double d = quotient(times, position, k), v = velocity[k];
    dd += d * d;
    vd += v * d;
    vv += v * v;
  }
  if (!(dd > 0.0 && vv > 0.0)) return {};
  return {vd / dd, vd / std::sqrt(dd * vv)};
}

void warn_of(const std::string& code, const JointRecording& recording, const std::string& message, const std::string& allowed,
             Warnings* warnings) {
  warnings->push_back(warn(code, {recording.where, recording.element, message + ": " + recording.file, "", allowed}));
}

/// Whether the position moves by more than its noise: difference quotients over separate samples agree.
bool moves(const std::vector<double>& times, const std::vector<double>& position) {
  constexpr double kAlike = 0.5;
  constexpr std::size_t kApart = 2 * kSpan + 1;
  double products = 0.0, squares = 0.0;
  for (std::size_t k = kSpan; k + kSpan + kApart < times.size(); ++k) {
    const double d = quotient(times, position, k);
    products += d * quotient(times, position, k + kApart);
    squares += d * d;
  }
  return products > kAlike * squares;
}

/// Whether one column is the derivative of the other one, in the same units.
bool is_derivative(const std::vector<double>& times, const std::vector<double>& position, const std::vector<double>& velocity) {
  constexpr double kTolerated = 0.2;
  if (position.empty() || velocity.empty()) return false;
  const Proportion found = by_differences(times, position, velocity);
  return found.correlation > kProportional && std::abs(found.factor - 1.0) < kTolerated;
}

/// What the velocity column holds instead, if a simple mistake tells.
std::string mistaken_velocity(const JointRecording& recording, const JointSamples& samples) {
  if (is_derivative(recording.times, samples.velocity, samples.position)) return "it is the other way round: the two columns are exchanged";
  for (const JointSamples& other : recording.joints)
    if (other.joint != samples.joint && is_derivative(recording.times, samples.position, other.velocity))
      return "the velocity of " + other.joint + " is: columns are exchanged";
  return "";
}

void check_velocity(const JointRecording& recording, const JointSamples& samples, Warnings* warnings) {
  constexpr double kUnlike = 0.5;
  if (samples.position.empty() || samples.velocity.empty() || is_derivative(recording.times, samples.position, samples.velocity)) return;
  const Proportion found = by_differences(recording.times, samples.position, samples.velocity);
  const std::string mistake = mistaken_velocity(recording, samples);
  // Noise may hide a slow motion, and is no mistake.
  const bool both_move = moves(recording.times, samples.position) && moves(recording.times, samples.velocity);
  if (!mistake.empty() || (std::abs(found.correlation) < kUnlike && both_move))
    warn_of("recording_velocity", recording,
            "the velocity of " + samples.joint + " is not the derivative of its position (correlation " + readable(found.correlation, 2) +
                ")" + (mistake.empty() ? "" : "; " + mistake),
            "columns of the same joint; without a velocity, the derivative of the position is used", warnings);
  else if (std::abs(found.correlation) > kProportional)
    warn_of("recording_units", recording,
            "the velocity of " + samples.joint + " is " + readable(found.factor, 4) + " times the derivative of its position",
            "the same unit of angle or length, the same sign, and seconds; `scale` of a column converts", warnings);
}

void check_range(const JointRecording& recording, const JointSamples& samples, const JointDescription& joint, Warnings* warnings) {
  if (samples.position.empty() || !has_stops(joint)) return;
  const double lower = joint.limit->lower.nominal(), upper = joint.limit->upper.nominal();
  const auto [least, most] = std::minmax_element(samples.position.begin(), samples.position.end());
  const double beyond = std::max(lower - *least, *most - upper);
  if (!(beyond > 0.5 * (upper - lower))) return;
  warn_of("recording_beyond_limits", recording,
          "the position of " + samples.joint + " goes from " + readable(*least, 6) + " to " + readable(*most, 6) +
              ", far beyond the limits of the joint",
          "[" + readable(lower, 6) + ", " + readable(upper, 6) + "] in rad or m; `scale: 0.017453292519943295` converts degrees", warnings);
}

}  // namespace

void check_units(const RobotDescription& robot, const JointRecording& recording, Warnings* warnings) {
  for (const JointDescription& joint : robot.joints) {
    const JointSamples* samples = recording.find(joint.name);
    if (samples == nullptr) continue;
    check_velocity(recording, *samples, warnings);
    check_range(recording, *samples, joint, warnings);
  }
}

}  // namespace codesign
