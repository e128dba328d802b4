// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mechanism_codesign/Event.h>
#include <visualization_msgs/MarkerArray.h>

#include "ros/scene/recorded_run.h"
#include "ros/scene/scene_layout.h"

namespace codesign {

/// How long rviz shows an event [s].
inline constexpr double kEventLifetime = 0.5;

/// @param context with the stamp of the event.
mechanism_codesign::Event event_message(const Event& event, const MessageContext& context);

/// The expression of an event as a text above its link, for kEventLifetime; several events of one
/// link stand one above the other. @param index of the event in the run. @param frame of the run at
/// the event or just behind it. @param context with the frame of the root link.
visualization_msgs::MarkerArray event_markers(const RecordedRun& run, std::size_t index,
                                              const Frame& frame, const SceneLayout& layout,
                                              const MessageContext& context);

}  // namespace codesign
