// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <boost/make_shared.hpp>
#include <string>

#include "ros/bag_file.h"
#include "ros/frame_messages.h"

namespace codesign {

/// Writes runs into a bag. Recorded time is the time of the run plus 1 s, since rosbag refuses stamps near zero; header stamps are the
/// same.
class BagWriter {
 public:
  /// Every member function throws OutputError if writing fails. @param path must not exist.
  explicit BagWriter(const std::string& path) : bag_(path) {}

  static ros::Time stamp(double time) { return ros::Time(1.0 + time); }

  template <class Message>
  void write(const std::string& topic, double time, const Message& message) {
    bag_.write(topic, stamp(time), message);
  }

  /// Writes a message with the connection header that `rosbag record` uses for latched topics, so that `rosbag play` latches it.
  template <class Message>
  void write_latched(const std::string& topic, double time, const Message& message) {
    auto header = boost::make_shared<ros::M_string>();
    (*header)["type"] = ros::message_traits::datatype(message);
    (*header)["md5sum"] = ros::message_traits::md5sum(message);
    (*header)["message_definition"] = ros::message_traits::definition(message);
    (*header)["latching"] = "1";
    bag_.write(topic, stamp(time), message, header);
  }

  void write_text(const std::string& topic, const std::string& text);

  /// Writes one instant of a run to topics that begin with `topic_prefix`.
  /// @param root_frame TF frame of the root link.
  void write_frame(const std::string& topic_prefix, const std::string& root_frame, const FrameNames& names, const Frame& frame,
                   const MarkerStyle& style);

  /// Completes the bag and gives it its final name.
  void finish() { bag_.finish(); }

 private:
  BagFile bag_;
};

}  // namespace codesign
