// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "ros/scene/event_markers.h"

namespace codesign {

mechanism_codesign::Event event_message(const Event& event, const MessageContext& context) {
  mechanism_codesign::Event message;
  message.header = header_of(context);
  message.element = event.element;
  message.object = event.object;
  message.expression = event.expression;
  message.rising = event.rising;
  message.jump = event.jump;
  return message;
}

visualization_msgs::MarkerArray event_markers(const RecordedRun& run, std::size_t index,
                                              const Frame& frame, const SceneLayout& layout,
                                              const MessageContext& context) {
  constexpr double kSmaller = 0.7, kAbove = 2.0;
  const auto& [event, link] = run.events[index];
  // Events whose texts are seen at the same time have different lines.
  int below = 0;
  for (std::size_t k = index; k-- > 0;) {
    if (event.time - run.events[k].event.time >= kEventLifetime) break;
    if (run.events[k].link == link) ++below;
  }
  constexpr int kLines = 4;
  const double letter = kSmaller * layout.letter, line = kAbove + 1.5 * (below % kLines);
  visualization_msgs::MarkerArray message;
  message.markers.push_back(
      text_marker(event.expression + (event.rising ? " rising" : " falling"),
                  frame.links[link].position + line * letter * layout.view.up(), letter));
  visualization_msgs::Marker& marker = message.markers.back();
  marker.header = header_of(context);
  marker.ns = "event";
  marker.id = static_cast<std::int32_t>(index);
  marker.lifetime = ros::Duration(kEventLifetime);
  return message;
}

}  // namespace codesign
