// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "ros/bag_writer.h"

#include <std_msgs/String.h>

namespace codesign {

void BagWriter::write_text(const std::string& topic, const std::string& text) {
  std_msgs::String message;
  message.data = text;
  write_latched(topic, 0.0, message);
}

void BagWriter::write_frame(const std::string& topic_prefix, const std::string& root_frame, const FrameNames& names, const Frame& frame,
                            const MarkerStyle& style) {
  const MessageContext context{stamp(frame.time), root_frame};
  FrameMessages(names, frame, context, style).visit([&](const std::string& topic, const auto& message) {
    write(topic_prefix + topic, frame.time, message);
  });
}

}  // namespace codesign
