// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <rosbag/bag.h>
#include <sys/types.h>

#include <cerrno>
#include <memory>
#include <string>

namespace codesign {

/// A bag that is written as `path`.active and renamed to `path` when it is complete.
///
/// With a full disk, the destructor of rosbag::Bag tries to write again and throws, which ends the program. Here a failure is an
/// OutputError and the unfinished file is removed, so that the program can continue.
class BagFile {
 public:
  /// @throws OutputError if the file cannot be created, or if `path` or `path`.active exists.
  explicit BagFile(const std::string& path);

  /// Removes the file unless finish() succeeded.
  ~BagFile();
  BagFile(const BagFile&) = delete;
  BagFile& operator=(const BagFile&) = delete;

  /// @throws OutputError; the bag is then removed and must not be used any more.
  template <class Message>
  void write(const std::string& topic, const ros::Time& time, const Message& message, const boost::shared_ptr<ros::M_string>& header = {}) {
    guard([&] { bag_->write(topic, time, message, header); });
  }

  /// Writes the index and renames the bag to `path`, which must not exist. @throws OutputError; the bag is then removed.
  void finish();

 private:
  template <class Action>
  void guard(Action&& action) {
    errno = 0;
    try {
      action();
    } catch (const rosbag::BagException&) {
      fail(errno);
    }
  }
  [[noreturn]] void fail(int cause);
  void abandon() noexcept;
  bool divert() const noexcept;

  std::string path_, active_;
  dev_t device_ = 0;  ///< device and inode identify the file's descriptor inside rosbag
  ino_t inode_ = 0;
  std::unique_ptr<rosbag::Bag> bag_;
};

}  // namespace codesign
