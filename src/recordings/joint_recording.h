// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <atomic>
#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "description/identification.h"
#include "description/robot.h"
#include "mechanism_codesign/warning.h"

namespace codesign {

/// The measurements of one joint, one number per time in the joint's units. An empty column was not
/// measured.
struct JointSamples {
  std::string joint;
  std::vector<double> position, velocity, effort;
  /// position at the first time, if velocities are to be integrated
  std::optional<FittedNumber> start = std::nullopt;
  bool is_prescribed = false;  ///< not recorded, but computed from the study's `motion`
  /// samples at which the joint is slower do not count in its residuals [rad/s or m/s]
  double least_speed = 0.0;
  bool has_bounds = false;  ///< slower samples count by bounds of their effort

  std::vector<double>& of(MeasuredQuantity quantity) {
    return quantity == MeasuredQuantity::kPosition   ? position
           : quantity == MeasuredQuantity::kVelocity ? velocity
                                                     : effort;
  }
  const std::vector<double>& of(MeasuredQuantity quantity) const {
    return const_cast<JointSamples*>(this)->of(quantity);
  }
};

/// A measured signal of the model, as an IMU or a force sensor shows it.
struct SignalSamples {
  SignalDescription signal;
  std::vector<double> values;  ///< one per time, in SI units
};

/// Measurements of several joints at common times. The recordings of load_recordings() have
/// ascending times, finite numbers and no gap.
struct JointRecording {
  std::string file;   ///< the path that was read
  std::string topic;  ///< topic in a bag; empty for a table
  /// [s], from the column of a table, or counted from the begin of the bag
  std::vector<double> times;
  /// one per time: the line of the file, or the number of the topic's message, from 1
  std::vector<std::size_t> places;
  std::vector<JointSamples> joints;
  std::vector<SignalSamples> signals;
  std::vector<RecordedSetting> settings;  ///< values of parameters in this recording
  std::string element;    ///< the entry of the study, for messages: `identify.data[0]`
  SourceLocation where;   ///< place of this entry, for messages
  bool is_given = false;  ///< by a program as arrays: neither a table nor a bag

  /// The samples of a joint; null if it was not recorded.
  const JointSamples* find(const std::string& joint) const;
  /// The place of sample k in words: `line 812, t = 8.11 s`. Places of given arrays are numbers of
  /// samples, from 1.
  std::string place_of(std::size_t k) const;
  /// The file and, for a table, the line of sample k.
  SourceLocation location_of(std::size_t k) const;
};

/// Whether both recordings give the same parameters the same values, in the same order.
bool has_same_settings(const JointRecording& one, const JointRecording& other);

/// Samples `begin` to `end` - 1. @param begin at most `end`, which is at most the number of samples
JointRecording part_of(const JointRecording& recording, std::size_t begin, std::size_t end);

/// Callback that reads the joint states of a topic from a bag. The caller provides it, since this
/// library does not depend on ROS, which reads bags.
/// @param path of the bag. @param joints names of the model's joints with one coordinate; other
/// joints in the messages are ignored.
/// @throws InputError if the bag or topic cannot be read, or names none of the joints.
using BagReader =
    std::function<JointRecording(const RecordingDescription& description, const std::string& path,
                                 const std::vector<std::string>& joints, Warnings* warnings)>;

/// The recordings of a study.
struct StudyRecordings {
  std::vector<JointRecording> data, holdout;
};

/// Looks for mistakes, one check after the other until it is cancelled, and mends turns and stamps:
/// check_spikes(), unwrap_turns(), check_units(), even_stamps().
void check_part(const RobotDescription& robot, JointRecording* part, Warnings* warnings,
                const std::atomic<bool>* cancel = nullptr);

/// Reads and checks the recordings that a study names: checked_part(), check_part(),
/// without_gaps(). Each recording must have all joints of
/// `identify.joints`.
/// @param folder base of relative paths; empty: only absolute paths are accepted.
/// @param reader reads bags; if it is empty, a study that names a bag is refused.
/// @param cancel soon after this is set, from any thread, it returns; recordings may then be
/// missing and unchecked, and are for nothing but identify(), which ends as cancelled. null: never
/// @throws InputError with the place in the study or in the file.
StudyRecordings load_recordings(const IdentificationDescription& identification,
                                const RobotDescription& robot, const std::string& folder,
                                const BagReader& reader, Warnings* warnings,
                                const std::atomic<bool>* cancel = nullptr);

}  // namespace codesign
