// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "jobs/lock_file.h"

#include <gtest/gtest.h>

#include <fstream>

#include "child_process.h"
#include "jobs/output_error.h"
#include "temporary_directory.h"

namespace codesign {
namespace {

class Locks : public testing::Test {
 protected:
  bool is_there() const { return std::filesystem::exists(path_); }

  TemporaryDirectory directory_;
  std::string path_ = (directory_.path() / "lock").string();
};

TEST_F(Locks, ANameIsCreatedOnceUntilItIsGivenBack) {
  {
    const auto lock = LockFile::create(path_);
    ASSERT_TRUE(lock);
    EXPECT_FALSE(LockFile::create(path_));
    EXPECT_FALSE(LockFile::take(path_));
    EXPECT_FALSE(LockFile::take_abandoned(path_));
    EXPECT_TRUE(is_there());
  }
  EXPECT_FALSE(is_there());
  EXPECT_TRUE(LockFile::create(path_));
}

TEST_F(Locks, WhatAKilledProcessLeftBehindCanBeTaken) {
  const pid_t child = fork();
  if (child == 0) {
    const auto lock = LockFile::create(path_);
    raise(SIGKILL);
  }
  int status = 0;
  waitpid(child, &status, 0);
  ASSERT_TRUE(is_there());
  EXPECT_FALSE(LockFile::create(path_));
  EXPECT_TRUE(LockFile::take_abandoned(path_));
  EXPECT_FALSE(is_there());
}

TEST_F(Locks, NothingThatIsNotThereIsAbandoned) { EXPECT_FALSE(LockFile::take_abandoned(path_)); }

TEST_F(Locks, AFolderThatIsMissingIsAnOutputError) {
  EXPECT_THROW(LockFile::create("/nonexistent/lock"), OutputError);
  EXPECT_THROW(LockFile::take("/nonexistent/lock"), OutputError);
}

TEST_F(Locks, OfManyProcessesEachGetsAnother) {
  constexpr int kProcesses = 16;
  for (int k = 0; k < kProcesses; ++k) {
    if (fork() != 0) continue;
    for (int number = 0;; ++number) {
      const auto lock = LockFile::create(path_ + std::to_string(number));
      if (!lock) continue;
      std::ofstream((directory_.path() / "log").string() + std::to_string(number), std::ios::app) << "x";
      usleep(200000);
      _exit(0);
    }
  }
  for (int k = 0; k < kProcesses; ++k) waitpid(-1, nullptr, 0);
  for (int number = 0; number < kProcesses; ++number)
    EXPECT_EQ(std::filesystem::file_size((directory_.path() / "log").string() + std::to_string(number)), 1U) << number;
}

}  // namespace
}  // namespace codesign
