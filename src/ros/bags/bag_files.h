// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <atomic>
#include <string>
#include <vector>

#include "description/reference.h"
#include "excitation/trajectory_basis.h"
#include "jobs/bag_files.h"
#include "recordings/joint_recording.h"

namespace codesign {

/// Reads the sensor_msgs/JointState messages of a topic.
///
/// Times count from the first message of the bag: the first message of the topic has its time of
/// reception, the others follow by the differences of their stamps. Several publishers may share
/// the topic; the messages that name most of the joints are used, and `recording_joints_left_out`
/// warns of the others. An array that is empty in all messages, or NaN throughout, was not
/// measured. `recording_clock` warns where stamps and times of reception differ by more than half a
/// second, `recording_all_zero` of efforts and velocities that are zero throughout.
/// @throws InputError as BagReader, and for stamps of zero and arrays whose sizes differ from the
/// number of names.
JointRecording read_recording_bag(const RecordingDescription& description, const std::string& path,
                                  const std::vector<std::string>& joints, Warnings* warnings);

/// A reader that calls read_recording_bag() and throws ReadingCancelled (ros/bags/bag_contents.h)
/// soon after `cancel` is set, from any thread. `cancel` must outlive the reader.
BagReader cancellable_bag_reader(const std::atomic<bool>& cancel);

/// A loader that reads the way-points of one joint from a bag: from the one
/// trajectory_msgs/JointTrajectory of a topic that names the joint. Fails with an InputError if
/// there is none, or more than one.
/// @param folder base of relative bag paths; empty: only absolute paths are accepted.
TrajectoryLoader bag_trajectory_loader(const std::string& folder);

/// The topic of the message.
inline constexpr const char* kTrajectoryTopic = "joint_trajectory";

/// Writes points as one trajectory_msgs/JointTrajectory on the topic `joint_trajectory`, with
/// velocities, accelerations and efforts; the stamp of its header is zero, which controllers take
/// as "now". @throws OutputError. An existing file is replaced.
void write_joint_trajectory_bag(const std::string& path, const TrajectoryPoints& points);

}  // namespace codesign

/// The functions of libcodesign_bags.so, which loaded_bag_files.cc finds by this name. They stay
/// valid until the program ends.
extern "C" const codesign::BagFiles* codesign_bag_files();
