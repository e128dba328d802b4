// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "ros/bags/bag_writer.h"

#include <gtest/gtest.h>
#include <rosbag/view.h>
#include <std_msgs/String.h>

#include <fstream>

#include "child_process.h"
#include "jobs/files.h"
#include "temporary_directory.h"

namespace codesign {
namespace {

std_msgs::String text(std::size_t length) {
  std_msgs::String message;
  message.data = std::string(length, 'x');
  return message;
}

class Bags : public testing::Test {
 protected:
  bool is_empty() const { return std::filesystem::is_empty(directory_.path()); }

  /// Runs `action` in a process of its own, where no file may grow beyond `bytes`, as on a full
  /// disk. Returns its exit code; an abort is 134.
  static int with_room_for(rlim_t bytes, const std::function<int()>& action) {
    const pid_t child = fork();
    if (child == 0) {
      std::signal(SIGXFSZ, SIG_IGN);
      const rlimit limit{bytes, bytes};
      setrlimit(RLIMIT_FSIZE, &limit);
      _exit(action());
    }
    int status = 0;
    waitpid(child, &status, 0);
    return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  }

  /// 0: whole; 1: an OutputError that names path and cause.
  int write_some() const {
    try {
      BagFile bag(path_);
      for (int k = 0; k < 400; ++k) bag.write("topic", ros::Time(1 + k), text(1000));
      bag.finish();
      return 0;
    } catch (const OutputError& error) {
      return std::string(error.what()) == path_ + ": cannot be written: File too large" ? 1 : 2;
    }
  }

  TemporaryDirectory directory_;
  std::string path_ = (directory_.path() / "a.bag").string();
};

TEST_F(Bags, AFinishedOneHasItsNameAndItsMessages) {
  ASSERT_EQ(write_some(), 0);
  EXPECT_FALSE(std::filesystem::exists(path_ + ".active"));
  rosbag::Bag bag(path_);
  EXPECT_EQ(rosbag::View(bag).size(), 400U);
}

TEST_F(Bags, OneThatIsNotFinishedLeavesNothing) {
  {
    BagFile bag(path_);
    bag.write("topic", ros::Time(1), text(10));
    EXPECT_TRUE(std::filesystem::exists(path_ + ".active"));
  }
  EXPECT_TRUE(is_empty());
}

TEST_F(Bags, NoRoomAtAnyPlaceIsAnErrorThatLeavesNothing) {
  // The bag has 440 kB: no room for its header, within its first chunk, at the chunk's end, in the
  // index; and just enough.
  for (rlim_t room = 1000; room < 460000; room = room * 9 / 8 + 100) {
    const int code = with_room_for(room, [this] { return write_some(); });
    if (code == 0) std::filesystem::remove(path_);
    EXPECT_LE(code, 1) << room << " bytes";
    EXPECT_TRUE(is_empty()) << room << " bytes";
  }
  const auto size = [this] {
    write_some();
    return std::filesystem::file_size(path_);
  }();
  std::filesystem::remove(path_);
  for (const rlim_t missing : {1U, 100U, 4000U, 5000U, 10000U, 20000U}) {
    EXPECT_EQ(with_room_for(size - missing, [this] { return write_some(); }), 1)
        << missing << " bytes short";
    EXPECT_TRUE(is_empty()) << missing << " bytes short";
  }
  EXPECT_EQ(with_room_for(size, [this] { return write_some(); }), 0);
}

TEST_F(Bags, NoDescriptorIsLeftOpenAfterAFailure) {
  const int code = with_room_for(50000, [this] {
    for (int k = 0; k < 50; ++k)
      if (write_some() != 1) return 3;
    const auto entries = std::filesystem::directory_iterator("/proc/self/fd");
    return std::distance(begin(entries), end(entries)) < 40 ? 0 : 4;
  });
  EXPECT_EQ(code, 0);
}

TEST_F(Bags, AnotherOnesFileIsNotTouched) {
  std::ofstream(path_ + ".active") << "another's";
  EXPECT_THROW(BagFile bag(path_), OutputError);
  EXPECT_TRUE(std::filesystem::exists(path_ + ".active"));
  std::filesystem::remove(path_ + ".active");
  BagFile bag(path_);
  std::ofstream(path_) << "finished";
  EXPECT_THROW(bag.finish(), OutputError);
  EXPECT_FALSE(std::filesystem::exists(path_ + ".active"));
  EXPECT_EQ(std::filesystem::file_size(path_), 8U);
}

TEST_F(Bags, AMissingFolderIsAnError) { EXPECT_THROW(BagFile("/nonexistent/a.bag"), OutputError); }

}  // namespace
}  // namespace codesign
