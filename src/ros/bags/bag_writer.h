// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ros/message_traits.h>
#include <ros/serialization.h>
#include <sys/types.h>

#include <boost/make_shared.hpp>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "ros/scene/frame_messages.h"

namespace rosbag {
class Bag;
}

namespace codesign {

/// A message as a bag keeps it: what the bag says about its type, and its bytes.
struct BagBytes {
  const char *type, *md5sum, *definition;
  std::vector<std::uint8_t> bytes;
};

/// A bag that is written as `path`.active and renamed to `path` when it is complete.
///
/// With a full disk, the destructor of rosbag::Bag tries to write again and throws, which ends the
/// program. Here a failure is an OutputError and the unfinished file is removed, so that the
/// program can continue.
class BagFile {
 public:
  /// @throws OutputError if the file cannot be created, or if `path` or `path`.active exists.
  explicit BagFile(const std::string& path);

  /// Removes the file unless finish() succeeded.
  ~BagFile();
  BagFile(const BagFile&) = delete;
  BagFile& operator=(const BagFile&) = delete;

  // The message becomes bytes here, so that rosbag's own templates, which take seconds to compile,
  // are compiled in one file.
  /// @throws OutputError; the bag is then removed and must not be used any more.
  template <class Message>
  void write(const std::string& topic, const ros::Time& time, const Message& message,
             const boost::shared_ptr<ros::M_string>& header = {}) {
    using namespace ros::message_traits;
    BagBytes content{datatype(message), md5sum(message), definition(message), {}};
    content.bytes.resize(ros::serialization::serializationLength(message));
    ros::serialization::OStream stream(content.bytes.data(),
                                       static_cast<std::uint32_t>(content.bytes.size()));
    ros::serialization::serialize(stream, message);
    write_bytes(topic, time, content, header);
  }

  /// Writes the index and renames the bag to `path`, which must not exist. @throws OutputError; the
  /// bag is then removed.
  void finish();

 private:
  template <class Action>
  void guard(const Action& action);
  void write_bytes(const std::string& topic, const ros::Time& time, const BagBytes& content,
                   const boost::shared_ptr<ros::M_string>& header);
  [[noreturn]] void fail(int cause);
  void abandon() noexcept;
  bool divert() const noexcept;

  std::string path_, active_;
  dev_t device_ = 0;  ///< device and inode identify the file's descriptor inside rosbag
  ino_t inode_ = 0;
  std::unique_ptr<rosbag::Bag> bag_;
};

/// Writes runs into a bag. Recorded time is the time of the run plus 1 s, since rosbag refuses
/// stamps near zero; header stamps are the same. Every member function throws OutputError if
/// writing fails.
class BagWriter : public BagFile {
 public:
  using BagFile::BagFile;

  static ros::Time stamp(double time) { return ros::Time(1.0 + time); }

  template <class Message>
  void write(const std::string& topic, double time, const Message& message) {
    BagFile::write(topic, stamp(time), message);
  }

  /// Writes a message with the connection header that `rosbag record` uses for latched topics, so
  /// that `rosbag play` latches it.
  template <class Message>
  void write_latched(const std::string& topic, double time, const Message& message) {
    auto header = boost::make_shared<ros::M_string>();
    (*header)["type"] = ros::message_traits::datatype(message);
    (*header)["md5sum"] = ros::message_traits::md5sum(message);
    (*header)["message_definition"] = ros::message_traits::definition(message);
    (*header)["latching"] = "1";
    BagFile::write(topic, stamp(time), message, header);
  }

  void write_text(const std::string& topic, const std::string& text);

  /// Writes one instant of a run to topics that begin with `topic_prefix`.
  /// @param root_frame TF frame of the root link.
  void write_frame(const std::string& topic_prefix, const std::string& root_frame,
                   const FrameNames& names, const Frame& frame, const MarkerStyle& style);
};

}  // namespace codesign
