// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <atomic>
#include <string>
#include <vector>

#include "recordings/joint_recording.h"
#include "ros/bag_contents.h"

namespace codesign {

/// Reads the sensor_msgs/JointState messages of a topic.
///
/// Times count from the first message of the bag: the first message of the topic has its time of reception, the others follow by the
/// differences of their stamps. Several publishers may share the topic; the messages that name most of the joints are used, and
/// `recording_joints_left_out` warns of the others. An array that is empty in all messages, or NaN throughout, was not measured.
/// `recording_clock` warns where stamps and times of reception differ by more than half a second, `recording_all_zero` of efforts and
/// velocities that are zero throughout.
/// @throws InputError as BagReader, and for stamps of zero and arrays whose sizes differ from the number of names.
JointRecording read_recording_bag(const RecordingDescription& description, const std::string& path, const std::vector<std::string>& joints,
                                  Warnings* warnings);

/// A reader that calls read_recording_bag() and throws ReadingCancelled (ros/bag_contents.h) soon after `cancel` is set, from any thread.
/// `cancel` must outlive the reader.
BagReader cancellable_bag_reader(const std::atomic<bool>& cancel);

}  // namespace codesign
