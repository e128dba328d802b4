// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "recordings/joint_recording.h"

#include <algorithm>

#include "text/number_text.h"

namespace codesign {

const JointSamples* JointRecording::find(const std::string& joint) const {
  const auto found = std::find_if(joints.begin(), joints.end(), [&joint](const JointSamples& samples) { return samples.joint == joint; });
  return found == joints.end() ? nullptr : &*found;
}

std::string JointRecording::place_of(std::size_t k) const {
  return (topic.empty() ? "line " : "message ") + std::to_string(places[k]) + ", t = " + readable(times[k]) + " s";
}

SourceLocation JointRecording::location_of(std::size_t k) const { return {file, topic.empty() ? static_cast<int>(places[k]) : 0}; }

bool has_same_settings(const JointRecording& one, const JointRecording& other) {
  return std::equal(one.settings.begin(), one.settings.end(), other.settings.begin(), other.settings.end(),
                    [](const RecordedSetting& a, const RecordedSetting& b) { return a.parameter == b.parameter && a.value == b.value; });
}

JointRecording part_of(const JointRecording& recording, std::size_t begin, std::size_t end) {
  const auto cut = [begin, end](const auto& column) {
    auto part = column;
    if (!column.empty())
      part.assign(column.begin() + static_cast<std::ptrdiff_t>(begin), column.begin() + static_cast<std::ptrdiff_t>(end));
    return part;
  };
  JointRecording part;
  part.file = recording.file;
  part.topic = recording.topic;
  part.settings = recording.settings;
  part.element = recording.element;
  part.where = recording.where;
  part.times = cut(recording.times);
  part.places = cut(recording.places);
  for (const JointSamples& samples : recording.joints)
    part.joints.push_back({samples.joint, cut(samples.position), cut(samples.velocity), cut(samples.effort), samples.start});
  return part;
}

}  // namespace codesign
