// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>
#include "identification/segment_system.h"

namespace codesign {

struct Segment;

/// Cuts a recording into segments of about `segment.segment` seconds, each sample in one segment; only every `filter.decimate`th sample
/// counts. Starts are the recorded positions, filtered at `filter.cutoff`, with recorded or differentiated velocities; integrals are zero.
/// The tree coordinates are empty; set_branches() sets them.
/// @param independent joints whose positions and velocities make up a start.
/// @throws InputError if a segment has fewer samples than its start has numbers.
std::vector<Segment> cut_into_segments(const JointRecording& recording, const SegmentSystem& of, const FitVariables& variables,
                                       const std::vector<std::string>& independent, const IdentificationDescription& options,
                                       Warnings* warnings);

/// Follows the recorded positions from the start of the study `usual` through the recording, so that each segment of a mechanism with loops
/// starts on the recorded branch. @param x the start of the fit
Status set_branches(const JointRecording& recording, const SegmentSystem& of, const CompiledSystem& usual, const FitVariables& variables,
                    const Eigen::VectorXd& x, const std::vector<std::string>& independent, const std::atomic<bool>* cancel,
                    std::vector<Segment>* segments);

}  // namespace codesign
