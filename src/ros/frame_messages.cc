// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "ros/frame_messages.h"

namespace codesign {

FrameMessages::FrameMessages(const FrameNames& names, const Frame& frame, const MessageContext& context, const MarkerStyle& style)
    : joint_states(codesign::joint_states(names, frame, context)),
      joint_friction(codesign::joint_friction(names, frame, context)),
      controller_states(codesign::controller_states(names, frame, context)),
      loop_errors(codesign::loop_errors(names, frame, context)),
      signals(codesign::signals(names, frame, context)),
      friction_markers(codesign::friction_markers(names, frame, context, style)) {}

}  // namespace codesign
