// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "recordings/joint_recording.h"

#include <algorithm>
#include <filesystem>
#include <utility>

#include "description/named_file.h"
#include "description/recording_masks.h"
#include "math/arrays.h"
#include "recordings/even_stamps.h"
#include "recordings/measured_motion.h"
#include "recordings/number_table.h"
#include "recordings/recording_check.h"
#include "text/cancel.h"
#include "text/nearest_name.h"
#include "text/number_text.h"

namespace codesign {
namespace {

/// Data that all recordings of a study share.
struct Context {
  const IdentificationDescription& identification;
  const RobotDescription& robot;
  const std::string& folder;
  const BagReader& reader;
  Warnings* warnings;
  const std::atomic<bool>* cancel;
  std::vector<std::string> joints;
};

JointRecording read(const RecordingDescription& description, const Context& context) {
  const std::string element = description.element + (description.is_bag ? ".bag" : ".csv");
  const std::string path = path_of({description.file, description.where, element}, context.folder);
  std::error_code unknown;
  if (!description.is_bag && !std::filesystem::exists(path, unknown) && !unknown)
    throw InputError(
        {description.where, element, "there is no such recording", path,
         "a recording of the robot, in the folder of the study or with its absolute path; "
         "doc/case_studies.md has the commands "
         "that make those of the shipped cases by simulation, beside a copy of the study"});
  if (!description.is_bag) return read_table_recording(description, path, context.joints);
  if (!context.reader)
    throw InputError({description.where, element,
                      "this program is installed without ROS, which reads bags", path,
                      "csv: FILE; `rostopic echo -b BAG -p TOPIC` writes such a table where ROS is "
                      "there; or the Debian package ros-mechanism-codesign"});
  return context.reader(description, path, context.joints, context.warnings);
}

/// Each joint that the study calibrates must have been recorded with an effort.
void require_calibrated_joints(const JointRecording& recording,
                               const IdentificationDescription& identification) {
  std::vector<std::string> names;
  for (const JointSamples& samples : recording.joints) names.push_back(samples.joint);
  for (const JointCalibration& calibration : identification.joints) {
    const std::string element = "identify.joints." + calibration.joint;
    const JointSamples* samples = recording.find(calibration.joint);
    if (samples == nullptr)
      throw unknown_name(calibration.where, element, "joint in " + recording.file,
                         calibration.joint, names);
    if (samples->effort.empty())
      throw InputError(
          {calibration.where, element,
           "no effort of this joint was recorded, which its scale, delay and offset are about",
           recording.file, "a recording with " + calibration.joint + "/effort"});
  }
}

/// Sets the start positions of the joints of a recording.
void add_starts(const RecordingDescription& description, JointRecording* recording) {
  std::vector<std::string> names;
  for (const JointSamples& samples : recording->joints) names.push_back(samples.joint);
  for (const StartPosition& start : description.starts) {
    const std::string element = description.element + ".start." + start.joint;
    const auto found = std::find_if(
        recording->joints.begin(), recording->joints.end(),
        [&start](const JointSamples& samples) { return samples.joint == start.joint; });
    if (found == recording->joints.end())
      throw unknown_name(start.position.where, element, "joint in " + recording->file, start.joint,
                         names);
    if (!found->position.empty())
      throw InputError(
          {start.position.where, element,
           "positions of this joint were recorded, which give its start: " + recording->file,
           start.joint, "no start, or columns without its positions"});
    if (found->velocity.empty())
      throw InputError({start.position.where, element,
                        "no velocity of this joint was recorded, from which positions follow: " +
                            recording->file,
                        start.joint, "a recording with " + start.joint + "/velocity"});
    found->start = start.position;
  }
}

/// Sets the speeds below which samples of joints do not count.
void add_masks(const RecordingDescription& description, JointRecording* recording) {
  std::vector<std::string> names;
  for (const JointSamples& samples : recording->joints) names.push_back(samples.joint);
  for (const SpeedMask& mask : description.masks) {
    if (!mask.joint.empty() && std::find(names.begin(), names.end(), mask.joint) == names.end())
      throw unknown_name(mask.where, description.element + ".mask.speed." + mask.joint,
                         "joint in " + recording->file, mask.joint, names);
    for (JointSamples& samples : recording->joints)
      if (mask.joint.empty() || samples.joint == mask.joint) {
        samples.least_speed = mask.speed;
        samples.has_bounds = description.rest == RestRule::kBounds;
      }
  }
}

/// If only the velocity of a joint is recorded, its motion during a gap is unknown.
void require_one_piece(const RecordingDescription& description,
                       const std::vector<JointRecording>& pieces) {
  if (pieces.size() < 2 || description.starts.empty()) return;
  throw InputError({description.where, description.element + ".gaps",
                    "after a gap the positions of joints without recorded positions are unknown: " +
                        pieces.front().file,
                    "split", "one entry for each piece, with `from`, `to` and `start`"});
}

/// Pieces between gaps that the filters shorten too much are left out, unless all are.
std::vector<JointRecording> long_enough(std::vector<JointRecording> pieces,
                                        const Context& context) {
  const IdentificationDescription& options = context.identification;
  const auto is_short = [&options](const JointRecording& piece) {
    return samples_to_fit(piece, options.filter) < to_signed(kLeastSamples);
  };
  if (options.residual != ResidualKind::kEffort ||
      std::all_of(pieces.begin(), pieces.end(), is_short))
    return pieces;
  const auto short_ones = std::stable_partition(
      pieces.begin(), pieces.end(), [&](const auto& piece) { return !is_short(piece); });
  for (auto piece = short_ones; piece != pieces.end(); ++piece)
    context.warnings->push_back(warn(
        "recording_piece_dropped",
        {piece->location_of(0), piece->element,
         "a piece of " + std::to_string(piece->times.size()) +
             " samples between gaps is left out (" + piece->place_of(0) + "): the filters leave " +
             std::to_string(samples_to_fit(*piece, options.filter)) + " to fit",
         "", "at least " + std::to_string(kLeastSamples)}));
  pieces.erase(short_ones, pieces.end());
  return pieces;
}

std::vector<JointRecording> load(const std::vector<RecordingDescription>& descriptions,
                                 const Context& context) {
  std::vector<JointRecording> recordings;
  for (const RecordingDescription& description : descriptions) {
    if (is_set(context.cancel)) break;
    JointRecording whole = read(description, context);
    if (is_set(context.cancel)) break;
    whole.settings = description.settings;
    require_calibrated_joints(whole, context.identification);
    JointRecording part = checked_part(whole, description.from, description.to);
    add_starts(description, &part);
    refuse_masks_in_motion(description, context.identification.residual);
    add_masks(description, &part);
    check_part(context.robot, &part, context.warnings, context.cancel);
    if (is_set(context.cancel)) break;
    std::vector<JointRecording> pieces =
        without_gaps(part, description.gaps, context.warnings, !part.is_given);
    require_one_piece(description, pieces);
    for (JointRecording& piece : pieces)
      if (!is_set(context.cancel)) even_stamps(&piece, context.warnings);
    for (JointRecording& piece : long_enough(std::move(pieces), context))
      recordings.push_back(std::move(piece));
  }
  return recordings;
}

/// Whether the joints of one recording are the same at sample k as those of another one at sample
/// i.
bool is_same_sample(const JointRecording& one, std::size_t k, const JointRecording& other,
                    std::size_t i) {
  return std::all_of(one.joints.begin(), one.joints.end(), [&](const JointSamples& samples) {
    const JointSamples* same = other.find(samples.joint);
    const auto is_same = [k, i](const std::vector<double>& a, const std::vector<double>& b) {
      return a.empty() == b.empty() && (a.empty() || a[k] == b[i]);
    };
    return same != nullptr && is_same(samples.position, same->position) &&
           is_same(samples.velocity, same->velocity);
  });
}

/// Whether arrays, which have no file, are parts of one recording: at all common times the same.
/// Recordings of another motion may have a few samples in common, of a robot at rest.
bool share_arrays(const JointRecording& one, const JointRecording& other) {
  std::size_t common = 0, i = 0;
  for (std::size_t k = 0; k < one.times.size(); ++k) {
    while (i < other.times.size() && other.times[i] < one.times[k]) ++i;
    if (i == other.times.size()) break;
    if (other.times[i] != one.times[k]) continue;
    if (!is_same_sample(one, k, other, i)) return false;
    ++common;
  }
  return common >= kLeastSamples;
}

/// Whether two recordings have samples in common: the same places of one file, with the same
/// numbers.
bool share_samples(const JointRecording& one, const JointRecording& other) {
  if (one.is_given != other.is_given) return false;
  if (one.is_given) return share_arrays(one, other);
  const std::size_t place = std::max(one.places.front(), other.places.front());
  if (one.file != other.file || one.topic != other.topic ||
      place > std::min(one.places.back(), other.places.back()))
    return false;
  const auto index = [place](const JointRecording& recording) {
    return std::lower_bound(recording.places.begin(), recording.places.end(), place) -
           recording.places.begin();
  };
  return std::all_of(one.joints.begin(), one.joints.end(), [&](const JointSamples& samples) {
    const JointSamples* same = other.find(samples.joint);
    if (!same || same->position.size() != other.times.size() ||
        samples.position.size() != one.times.size())
      return same != nullptr;
    return samples.position[to_index(index(one))] == same->position[to_index(index(other))];
  });
}

/// Samples that are fitted twice count twice, and a holdout of fitted samples tells nothing.
void warn_of_repeated(const StudyRecordings& recordings, Warnings* warnings) {
  const auto check = [&](const JointRecording& recording, std::size_t count) {
    for (std::size_t k = 0; k < count; ++k)
      if (share_samples(recording, recordings.data[k])) {
        warnings->push_back(
            warn("recording_repeated",
                 {recording.where, recording.element,
                  "some of its samples are fitted as " + recordings.data[k].element + ": " +
                      recording.file,
                  "", "other recordings, or parts by `from` and `to` that do not overlap"}));
        return;
      }
  };
  for (std::size_t k = 1; k < recordings.data.size(); ++k) check(recordings.data[k], k);
  for (const JointRecording& holdout : recordings.holdout) check(holdout, recordings.data.size());
}

}  // namespace

const JointSamples* JointRecording::find(const std::string& joint) const {
  const auto found =
      std::find_if(joints.begin(), joints.end(),
                   [&joint](const JointSamples& samples) { return samples.joint == joint; });
  return found == joints.end() ? nullptr : &*found;
}

std::string JointRecording::place_of(std::size_t k) const {
  return (is_given        ? "sample "
          : topic.empty() ? "line "
                          : "message ") +
         std::to_string(places[k]) + ", t = " + readable(times[k]) + " s";
}

SourceLocation JointRecording::location_of(std::size_t k) const {
  return {file, topic.empty() && !is_given ? static_cast<int>(places[k]) : 0};
}

bool has_same_settings(const JointRecording& one, const JointRecording& other) {
  return std::equal(one.settings.begin(), one.settings.end(), other.settings.begin(),
                    other.settings.end(), [](const RecordedSetting& a, const RecordedSetting& b) {
                      return a.parameter == b.parameter && a.value == b.value;
                    });
}

JointRecording part_of(const JointRecording& recording, std::size_t begin, std::size_t end) {
  const auto cut = [begin, end](const auto& column) {
    auto part = column;
    if (!column.empty())
      part.assign(column.begin() + to_signed(begin), column.begin() + to_signed(end));
    return part;
  };
  JointRecording part;
  part.file = recording.file;
  part.topic = recording.topic;
  part.is_given = recording.is_given;
  part.settings = recording.settings;
  part.element = recording.element;
  part.where = recording.where;
  part.times = cut(recording.times);
  part.places = cut(recording.places);
  for (const JointSamples& samples : recording.joints)
    part.joints.push_back({samples.joint, cut(samples.position), cut(samples.velocity),
                           cut(samples.effort), samples.start, samples.is_prescribed,
                           samples.least_speed, samples.has_bounds});
  for (const SignalSamples& samples : recording.signals)
    part.signals.push_back({samples.signal, cut(samples.values)});
  return part;
}

void check_part(const RobotDescription& robot, JointRecording* part, Warnings* warnings,
                const std::atomic<bool>* cancel) {
  check_spikes(*part, warnings, cancel);
  if (is_set(cancel)) return;
  unwrap_turns(robot, part, warnings);
  check_units(robot, *part, warnings);
  if (is_set(cancel)) return;
  // Before gaps are looked for, since late stamps look like missing samples; and again behind it,
  // since a clock may go on differently after a gap.
  even_stamps(part, warnings);
}

StudyRecordings load_recordings(const IdentificationDescription& identification,
                                const RobotDescription& robot, const std::string& folder,
                                const BagReader& reader, Warnings* warnings,
                                const std::atomic<bool>* cancel) {
  Context context{identification, robot, folder, reader, warnings, cancel, {}};
  for (const JointDescription& joint : robot.joints)
    if (joint.has_one_coordinate()) context.joints.push_back(joint.name);
  StudyRecordings recordings{load(identification.data, context),
                             load(identification.holdout, context)};
  warn_of_repeated(recordings, warnings);
  return recordings;
}

}  // namespace codesign
