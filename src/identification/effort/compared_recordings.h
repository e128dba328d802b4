// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "identification/effort/driven_system.h"
#include "recordings/joint_recording.h"

namespace codesign {

/// The joints that all recordings measured, and whether their efforts were measured. Efforts that
/// are zero throughout count as not measured.
/// @throws InputError if a recording lacks a joint of another recording, or has neither position
/// nor start of a joint.
std::vector<MeasuredJoint> require_same_joints(const std::vector<JointRecording>& recordings);
/// @throws InputError if none of these joints has efforts, and no signal was recorded.
void require_efforts(const std::vector<MeasuredJoint>& joints,
                     const std::vector<JointRecording>& recordings);
/// @param outputs joints, then signals. @param counted ResidualSource::counted() of these
/// recordings
/// @throws InputError for a joint that is hardly ever as fast as its samples must be
void require_counted(const std::vector<std::string>& outputs, const Eigen::MatrixXd& counted,
                     const std::vector<JointRecording>& recordings);
/// Whether enough residuals of each output count.
bool is_counted(const Eigen::MatrixXd& counted);
/// The signals that all recordings hold. @throws InputError if a recording lacks one, or has others
std::vector<SignalDescription> require_same_signals(const std::vector<JointRecording>& recordings);

}  // namespace codesign
