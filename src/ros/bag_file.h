// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_ROS_BAG_FILE_H_
#define MECHANISM_CODESIGN_ROS_BAG_FILE_H_

#include <rosbag/bag.h>
#include <sys/types.h>

#include <cerrno>
#include <memory>
#include <string>

namespace codesign {

/// A bag that is being written as `path`.active and gets its name when it is whole.
///
/// rosbag cannot be left alone with a full disk: the destructor of a bag that could not be written tries again, throws, and so ends the
/// program. Here a failure is an OutputError, the unfinished file is removed, and the program goes on.
class BagFile {
 public:
  /// @throws OutputError if it cannot be made, or if `path` or `path`.active exists.
  explicit BagFile(const std::string& path);

  /// Removes a bag that is not finished.
  ~BagFile();
  BagFile(const BagFile&) = delete;
  BagFile& operator=(const BagFile&) = delete;

  /// @throws OutputError, after which the bag is gone.
  template <class Message>
  void write(const std::string& topic, const ros::Time& time, const Message& message, const boost::shared_ptr<ros::M_string>& header = {}) {
    guard([&] { bag_->write(topic, time, message, header); });
  }

  /// Writes the index and gives the bag its name, which must be free. @throws OutputError, after which the bag is gone.
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
  dev_t device_ = 0;  ///< of the file
  ino_t inode_ = 0;   ///< of the file
  std::unique_ptr<rosbag::Bag> bag_;
};

}  // namespace codesign

#endif  // MECHANISM_CODESIGN_ROS_BAG_FILE_H_
