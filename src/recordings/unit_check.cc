// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "recordings/unit_check.h"

#include <algorithm>
#include <cmath>

#include "text/number_text.h"

namespace codesign {
namespace {

/// The relation of a measured velocity to the difference quotients of the position: factor of proportion and correlation.
struct Proportion {
  double factor = 1.0, correlation = 0.0;
};

Proportion velocity_by_differences(const std::vector<double>& times, const JointSamples& samples) {
  // Over several samples, so that the steps of an encoder do not hide the motion.
  constexpr std::size_t kSpan = 5;
  double dd = 0.0, vd = 0.0, vv = 0.0;
  for (std::size_t k = kSpan; k + kSpan < times.size(); ++k) {
    const double d = (samples.position[k + kSpan] - samples.position[k - kSpan]) / (times[k + kSpan] - times[k - kSpan]);
    const double v = samples.velocity[k];
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

void check_velocity(const JointRecording& recording, const JointSamples& samples, Warnings* warnings) {
  constexpr double kProportional = 0.9, kTolerated = 0.2;
  if (samples.position.empty() || samples.velocity.empty()) return;
  const Proportion found = velocity_by_differences(recording.times, samples);
  if (std::abs(found.correlation) < kProportional || std::abs(found.factor - 1.0) < kTolerated) return;
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
