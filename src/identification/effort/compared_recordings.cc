// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "identification/effort/compared_recordings.h"

#include <algorithm>
#include <utility>

#include "math/arrays.h"
#include "recordings/recording_check.h"

namespace codesign {
namespace {

InputError recording_error(const JointRecording& recording, const std::string& message,
                           const std::string& value, const std::string& allowed) {
  return InputError({recording.where, recording.element, message, value, allowed});
}

bool has_positions(const JointSamples& samples) {
  return !samples.position.empty() || (!samples.velocity.empty() && samples.start);
}

// Drivers without a sensor and joints without a motor record zeros: their efforts are not known.
bool has_efforts(const JointSamples& samples) {
  return std::any_of(samples.effort.begin(), samples.effort.end(),
                     [](double effort) { return effort != 0.0; });
}

}  // namespace

std::vector<MeasuredJoint> require_same_joints(const std::vector<JointRecording>& recordings) {
  std::vector<MeasuredJoint> joints;
  const JointRecording& first = recordings.front();
  for (const JointSamples& samples : first.joints) {
    MeasuredJoint joint{samples.joint, has_efforts(samples), 1.0, first.where};
    if (!has_positions(samples))
      throw recording_error(first, "the recording has no positions of this joint", samples.joint,
                            samples.velocity.empty() ? "positions of each joint"
                                                     : "positions, or start: {" + samples.joint +
                                                           ": POSITION} with its velocity");
    for (const JointRecording& other : recordings) {
      const JointSamples* found = other.find(joint.name);
      if (!found || !has_positions(*found))
        throw recording_error(
            other, "the recording has no positions of a joint that " + first.element + " has",
            joint.name, "the same joints in all recordings");
      joint.with_effort = joint.with_effort && has_efforts(*found);
    }
    joints.push_back(std::move(joint));
  }
  for (const JointRecording& other : recordings)
    for (const JointSamples& samples : other.joints)
      if (!first.find(samples.joint))
        throw recording_error(other, "the recording has a joint that " + first.element + " lacks",
                              samples.joint, "the same joints in all recordings");
  return joints;
}

void require_efforts(const std::vector<MeasuredJoint>& joints,
                     const std::vector<JointRecording>& recordings) {
  if (recordings.front().signals.empty() &&
      std::none_of(joints.begin(), joints.end(),
                   [](const MeasuredJoint& joint) { return joint.with_effort; }))
    throw recording_error(recordings.front(),
                          "no joint has efforts in all recordings, so that there is nothing to fit",
                          "", "efforts of at least one joint, or residual: motion");
}

bool is_counted(const Eigen::MatrixXd& counted) {
  return counted.size() == 0 ||
         counted.colwise().sum().minCoeff() >= static_cast<double>(kLeastSamples);
}

void require_counted(const std::vector<std::string>& outputs, const Eigen::MatrixXd& counted,
                     const std::vector<JointRecording>& recordings) {
  for (Eigen::Index k = 0; k < counted.cols(); ++k) {
    if (is_counted(counted.col(k))) continue;
    const std::string& joint = outputs[to_index(k)];
    const auto masked =
        std::find_if(recordings.begin(), recordings.end(), [&joint](const JointRecording& of) {
          const JointSamples* samples = of.find(joint);
          return samples != nullptr && samples->least_speed > 0.0;
        });
    const JointRecording& named = masked == recordings.end() ? recordings.front() : *masked;
    throw InputError({named.where, named.element + ".mask.speed",
                      "the joint is hardly ever as fast: the mask leaves " +
                          std::to_string(static_cast<int>(counted.col(k).sum())) + " samples of " +
                          joint,
                      "", "a lower speed, or recordings in which the joint moves"});
  }
}

std::vector<SignalDescription> require_same_signals(const std::vector<JointRecording>& recordings) {
  std::vector<SignalDescription> signals;
  for (const SignalSamples& samples : recordings.front().signals) signals.push_back(samples.signal);
  for (const JointRecording& other : recordings)
    if (!std::equal(other.signals.begin(), other.signals.end(), signals.begin(), signals.end(),
                    [](const SignalSamples& one, const SignalDescription& same) {
                      return one.signal.text == same.text;
                    }))
      throw recording_error(other,
                            "the recording has other signals than " + recordings.front().element,
                            std::to_string(other.signals.size()) + " signals",
                            "the same signals in all recordings, in the same order");
  return signals;
}

}  // namespace codesign
