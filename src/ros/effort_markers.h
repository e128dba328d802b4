// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <visualization_msgs/MarkerArray.h>

#include <vector>

#include "identification/compared_motion.h"
#include "ros/friction_markers.h"
#include "ros/scene_text.h"

namespace codesign {

/// Scales of the arrows that show efforts: the largest one of each unit is as long as half the mechanism.
/// @param size of the mechanism [m].
MarkerStyle effort_style(const ComparedMotion& motion, double size);

/// The legend of these arrows, in their colors; empty if no effort is compared.
std::vector<CaptionLine> effort_legend(const MarkerStyle& style, const ComparedMotion& motion);

/// Two arrows for each compared joint, beside its child's origin, along its axis: the effort that the model needs (green), and around it
/// the recorded effort (grey, thick and transparent). If the model explains the recording, both arrows end at the same point.
/// @param context.root_frame the frame of the root link of the identified model.
visualization_msgs::MarkerArray effort_markers(const ComparedMotion& motion, const Frame& measured, const Frame& model,
                                               const MessageContext& context, const MarkerStyle& style);

}  // namespace codesign
