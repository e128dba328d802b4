// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "recordings/joint_recording.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numeric>
#include <utility>

#include "description/named_file.h"
#include "math/arrays.h"
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

/// Looks for mistakes, one check after the other until it is cancelled, and mends turns and stamps.
void check_part(JointRecording* part, const Context& context) {
  check_spikes(*part, context.warnings, context.cancel);
  if (is_set(context.cancel)) return;
  unwrap_turns(context.robot, part, context.warnings);
  check_units(context.robot, *part, context.warnings);
  if (is_set(context.cancel)) return;
  // Before gaps are looked for, since late stamps look like missing samples; and again behind it,
  // since a clock may go on differently after a gap.
  even_stamps(part, context.warnings);
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
    check_part(&part, context);
    if (is_set(context.cancel)) break;
    std::vector<JointRecording> pieces = without_gaps(part, description.gaps, context.warnings);
    require_one_piece(description, pieces);
    for (JointRecording& piece : pieces)
      if (!is_set(context.cancel)) even_stamps(&piece, context.warnings);
    for (JointRecording& piece : long_enough(std::move(pieces), context))
      recordings.push_back(std::move(piece));
  }
  return recordings;
}

/// Whether two recordings have samples in common: the same places of one file, with the same
/// numbers.
bool share_samples(const JointRecording& one, const JointRecording& other) {
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

/// Stamps beside the line of equal steps that fits them best: stamp k = at(k) + off[k].
struct StampLine {
  std::vector<double> number;  // of the step at which a sample was taken; more than the one before
  double start = 0.0, step = 0.0;
  std::vector<double> off;
  double largest = 0.0, spread = 0.0;  // of |off|: the most, and the root mean square [s]

  double at(std::size_t k) const { return start + number[k] * step; }
};

/// The mean of the usual periods: of stamps that are rounded, such as 3, 7 and 10 ms, the median is
/// another one.
double usual_period(const std::vector<double>& times) {
  const double median = median_period(times);
  double sum = 0.0, count = 0.0;
  for (std::size_t k = 1; k < times.size(); ++k)
    if (const double period = times[k] - times[k - 1];
        0.5 * median < period && period < 1.5 * median) {
      sum += period;
      count += 1.0;
    }
  return sum / count;
}

/// Numbers of steps. The expected time follows the stamps slowly, so that one that is late does not
/// move those behind it.
std::vector<double> step_numbers(const std::vector<double>& times) {
  constexpr double kFollow = 0.1;
  const double period = usual_period(times);
  std::vector<double> numbers{0.0};
  double expected = times.front();
  for (std::size_t k = 1; k < times.size(); ++k) {
    const double steps = std::max(1.0, std::round((times[k] - expected) / period));
    numbers.push_back(numbers.back() + steps);
    expected += steps * period;
    expected += kFollow * (times[k] - expected);
  }
  return numbers;
}

StampLine line_through(const std::vector<double>& times, std::vector<double> numbers) {
  StampLine line;
  line.number = std::move(numbers);
  const auto count = static_cast<double>(times.size());
  double mean_number = 0.0, mean_time = 0.0, nn = 0.0, nt = 0.0;
  for (std::size_t k = 0; k < times.size(); ++k) {
    mean_number += line.number[k] / count;
    mean_time += (times[k] - times.front()) / count;
  }
  for (std::size_t k = 0; k < times.size(); ++k) {
    nn += (line.number[k] - mean_number) * (line.number[k] - mean_number);
    nt += (line.number[k] - mean_number) * (times[k] - times.front() - mean_time);
  }
  line.step = nt / nn;
  line.start = times.front() + mean_time - line.step * mean_number;
  for (std::size_t k = 0; k < times.size(); ++k) {
    line.off.push_back(times[k] - line.at(k));
    line.largest = std::max(line.largest, std::abs(line.off.back()));
    line.spread += line.off.back() * line.off.back() / count;
  }
  line.spread = std::sqrt(line.spread);
  return line;
}

/// A pause may be a sample that is missing, or a stamp that is late: what leaves the smaller jitter
/// counts.
StampLine stamp_line(const std::vector<double>& times) {
  std::vector<double> whole(times.size());
  std::iota(whole.begin(), whole.end(), 0.0);
  StampLine with_missing = line_through(times, step_numbers(times)),
            without = line_through(times, std::move(whole));
  return with_missing.spread < without.spread ? with_missing : without;
}

/// What a column tells of `share` in x_k = x(at(k) + share off[k]): its estimate times its
/// information, and its information.
struct Evidence {
  double weighted = 0.0, information = 0.0;
};

/// Fourth differences of five neighbours take the smooth motion away and leave what jitter and
/// noise do.
Evidence evidence_of(const StampLine& line, const std::vector<double>& column) {
  const auto fourth = [](const auto& x) {
    return x(0) - 4.0 * x(1) + 6.0 * x(2) - 4.0 * x(3) + x(4);
  };
  double yy = 0.0, yz = 0.0, zz = 0.0, count = 0.0;
  for (std::size_t k = 0; k + 4 < column.size(); ++k) {
    if (line.number[k + 4] - line.number[k] != 4.0) continue;
    const double rate = (column[k + 4] - column[k]) / (4.0 * line.step);
    const double y = fourth([&](std::size_t j) { return column[k + j]; });
    const double z = rate * fourth([&](std::size_t j) { return line.off[k + j]; });
    yy += y * y;
    yz += y * z;
    zz += z * z;
    count += 1.0;
  }
  if (!(zz > 0.0) || count < static_cast<double>(kLeastSamples)) return {};
  const double variance = std::max((yy - yz * yz / zz) / count, 1e-12 * yy / count);
  return variance > 0.0 ? Evidence{yz / variance, zz / variance} : Evidence{};
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
                           cut(samples.effort), samples.start});
  return part;
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

void even_stamps(JointRecording* recording, Warnings* warnings) {
  constexpr double kExact = 1e-3, kMost = 2.0,
                   kMostSpread = 0.2;  // of a step; beyond, nothing tells which samples are missing
  constexpr double kHalf = 0.5, kDeviations = 5.0;
  const StampLine line = stamp_line(recording->times);
  if (line.largest < kExact * line.step || line.largest > kMost * line.step ||
      line.spread > kMostSpread * line.step)
    return;
  Evidence all;
  for (const JointSamples& samples : recording->joints) {
    const Evidence one =
        evidence_of(line, samples.position.empty() ? samples.velocity : samples.position);
    all.weighted += one.weighted;
    all.information += one.information;
  }
  if (!(all.information > 0.0)) return;
  const double share = all.weighted / all.information;
  if (!(kHalf - share > kDeviations / std::sqrt(all.information))) return;
  for (std::size_t k = 0; k < recording->times.size(); ++k) recording->times[k] = line.at(k);
  warnings->push_back(
      warn("recording_even_stamps",
           {recording->where, recording->element,
            "the times jitter by up to " + readable(line.largest, 3) +
                " s, but the motion does not: the samples are taken at equal steps of " +
                readable(line.step, 6) + " s: " + recording->file,
            "", ""}));
}

}  // namespace codesign
