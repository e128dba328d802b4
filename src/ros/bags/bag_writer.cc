// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "ros/bags/bag_writer.h"

#include <fcntl.h>
#include <rosbag/bag.h>
#include <std_msgs/String.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <filesystem>

#include "jobs/files.h"

// What rosbag asks of a type of message.
namespace ros {
namespace message_traits {

template <>
struct IsMessage<codesign::BagBytes> : TrueType {};

template <>
struct MD5Sum<codesign::BagBytes> {
  static const char* value(const codesign::BagBytes& content) { return content.md5sum; }
};

template <>
struct DataType<codesign::BagBytes> {
  static const char* value(const codesign::BagBytes& content) { return content.type; }
};

template <>
struct Definition<codesign::BagBytes> {
  static const char* value(const codesign::BagBytes& content) { return content.definition; }
};

}  // namespace message_traits

namespace serialization {

template <>
struct Serializer<codesign::BagBytes> {
  template <class Stream>
  static void write(Stream& stream, const codesign::BagBytes& content) {
    std::copy(content.bytes.begin(), content.bytes.end(),
              stream.advance(serializedLength(content)));
  }
  static std::uint32_t serializedLength(const codesign::BagBytes& content) {
    return static_cast<std::uint32_t>(content.bytes.size());
  }
};

}  // namespace serialization
}  // namespace ros

namespace codesign {

template <class Action>
void BagFile::guard(const Action& action) {
  errno = 0;
  try {
    action();
  } catch (const rosbag::BagException&) {
    fail(errno);
  }
}

BagFile::BagFile(const std::string& path)
    : path_(path), active_(path + ".active"), bag_(std::make_unique<rosbag::Bag>()) {
  if (access(path.c_str(), F_OK) == 0) throw OutputError::of_system(path, EEXIST);
  const int descriptor = open(active_.c_str(), O_CREAT | O_EXCL | O_WRONLY | O_CLOEXEC, 0666);
  if (descriptor < 0) throw OutputError::of_system(active_, errno);
  struct stat file {};
  fstat(descriptor, &file);
  close(descriptor);
  device_ = file.st_dev;
  inode_ = file.st_ino;
  guard([this] { bag_->open(active_, rosbag::bagmode::Write); });
}

BagFile::~BagFile() {
  if (!bag_) return;
  abandon();
  unlink(active_.c_str());
}

void BagFile::write_bytes(const std::string& topic, const ros::Time& time, const BagBytes& content,
                          const boost::shared_ptr<ros::M_string>& header) {
  guard([&] { bag_->write(topic, time, content, header); });
}

void BagFile::finish() {
  guard([this] { bag_->close(); });
  bag_.reset();
  try {
    give_final_name(active_, path_);
  } catch (const OutputError&) {
    unlink(active_.c_str());
    throw;
  }
}

void BagFile::fail(int cause) {
  abandon();
  unlink(active_.c_str());
  throw OutputError::of_system(path_, cause);
}

/// Closes the bag after its descriptor was redirected to /dev/null, so that the writes of its
/// destructor cannot fail.
void BagFile::abandon() noexcept {
  if (divert()) {
    try {
      bag_->close();
      bag_.reset();
      return;
    } catch (const std::exception&) {
    }
  }
  // The file was closed by a call that failed. The destructor would close it again and throw, so
  // the object is leaked on purpose.
  static_cast<void>(bag_.release());
}

/// Redirects every open descriptor of the file to /dev/null; rosbag does not give access to its
/// own. Returns whether there was any.
bool BagFile::divert() const noexcept {
  const int nowhere = open("/dev/null", O_RDWR | O_CLOEXEC);
  bool found = false;
  std::error_code error;
  for (std::filesystem::directory_iterator entry("/proc/self/fd", error), end;
       nowhere >= 0 && !error && entry != end; entry.increment(error)) {
    const int descriptor = std::atoi(entry->path().filename().c_str());
    struct stat file {};
    if (fstat(descriptor, &file) != 0 || file.st_dev != device_ || file.st_ino != inode_) continue;
    found = dup2(nowhere, descriptor) >= 0 || found;
  }
  if (nowhere >= 0) close(nowhere);
  return found;
}

void BagWriter::write_text(const std::string& topic, const std::string& text) {
  std_msgs::String message;
  message.data = text;
  write_latched(topic, 0.0, message);
}

void BagWriter::write_frame(const std::string& topic_prefix, const std::string& root_frame,
                            const FrameNames& names, const Frame& frame, const MarkerStyle& style) {
  const MessageContext context{stamp(frame.time), root_frame};
  FrameMessages(names, frame, context, style)
      .visit([&](const std::string& topic, const auto& message) {
        write(topic_prefix + topic, frame.time, message);
      });
}

}  // namespace codesign
