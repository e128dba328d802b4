// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <csignal>
#include <fstream>
#include <iterator>

#include "child_process.h"
#include "jobs/files.h"
#include "mechanism_codesign/error.h"
#include "temporary_directory.h"

namespace codesign {
namespace {

std::string content(const std::string& path) {
  std::ifstream file(path);
  return {std::istreambuf_iterator<char>(file), {}};
}

TEST(WholeFile, ReplacesAFileAndLeavesNoPart) {
  const TemporaryDirectory directory;
  const std::string path = (directory.path() / "a").string();
  write_whole_file(path, "first, longer");
  write_whole_file(path, "second");
  EXPECT_EQ(content(path), "second");
  EXPECT_FALSE(std::filesystem::exists(path + kPartSuffix));
}

TEST(WholeFile, NamesPathAndCause) {
  try {
    write_whole_file("/nonexistent/a", "x");
    ADD_FAILURE();
  } catch (const OutputError& error) {
    EXPECT_STREQ(error.what(), "/nonexistent/a: cannot be written: No such file or directory");
  }
}

/// As if the disk were full beyond so many bytes of a file.
class FullDisk {
 public:
  explicit FullDisk(rlim_t bytes) {
    getrlimit(RLIMIT_FSIZE, &before_);
    const rlimit limit{bytes, before_.rlim_max};
    setrlimit(RLIMIT_FSIZE, &limit);
    handler_ = std::signal(SIGXFSZ, SIG_IGN);
  }
  ~FullDisk() {
    setrlimit(RLIMIT_FSIZE, &before_);
    std::signal(SIGXFSZ, handler_);
  }
  FullDisk(const FullDisk&) = delete;
  FullDisk& operator=(const FullDisk&) = delete;

 private:
  rlimit before_{};
  void (*handler_)(int);
};

std::size_t entries(const std::filesystem::path& folder) {
  return static_cast<std::size_t>(std::distance(std::filesystem::directory_iterator(folder), {}));
}

TEST(WholeFile, AFullDiskLeavesTheOldFileAndNoPart) {
  const TemporaryDirectory directory;
  const std::string path = (directory.path() / "a").string();
  write_whole_file(path, "old");
  {
    const FullDisk full(8192);
    EXPECT_THROW(write_whole_file(path, std::string(100000, 'x')), OutputError);
    EXPECT_THROW(write_whole_file(path + "_new", std::string(100000, 'x')), OutputError);
  }
  EXPECT_EQ(content(path), "old");
  EXPECT_EQ(entries(directory.path()), 1U);
}

TEST(WholeFile, APartOfAKilledProcessIsNotFollowed) {
  const TemporaryDirectory directory;
  const std::string path = (directory.path() / "a").string(),
                    other = (directory.path() / "other").string();
  write_whole_file(other, "other");
  std::filesystem::create_symlink(other, path + kPartSuffix);
  write_whole_file(path, "new");
  EXPECT_EQ(content(path), "new");
  EXPECT_EQ(content(other), "other");
}

TEST(WholeFile, LinksStayAndTheirFilesAreReplaced) {
  const TemporaryDirectory directory;
  const auto in_folder = [&](const char* name) { return (directory.path() / name).string(); };
  std::filesystem::create_directory(in_folder("deeper"));
  write_whole_file(in_folder("deeper/file"), "old");
  std::filesystem::permissions(in_folder("deeper/file"), std::filesystem::perms(0640));
  // Relative, and over a second link; the last one leads to a file that is not there yet.
  std::filesystem::create_symlink("deeper/file", in_folder("first"));
  std::filesystem::create_symlink(in_folder("first"), in_folder("second"));
  std::filesystem::create_symlink("deeper/missing", in_folder("third"));
  write_whole_file(in_folder("second"), "new");
  write_whole_file(in_folder("third"), "made");
  EXPECT_EQ(content(in_folder("deeper/file")), "new");
  EXPECT_EQ(std::filesystem::status(in_folder("deeper/file")).permissions(),
            std::filesystem::perms(0640));
  EXPECT_EQ(content(in_folder("deeper/missing")), "made");
  for (const char* link : {"first", "second", "third"})
    EXPECT_TRUE(std::filesystem::is_symlink(in_folder(link))) << link;
  std::filesystem::create_symlink(in_folder("ring"), in_folder("ring"));
  EXPECT_THROW(write_whole_file(in_folder("ring"), "x"), OutputError);
}

TEST(WholeFile, DevicesAndFifosGetTheText) {
  const TemporaryDirectory directory;
  const auto in_folder = [&](const char* name) { return (directory.path() / name).string(); };
  // By a link, since a program that does otherwise would take the machine's device away.
  std::filesystem::create_symlink("/dev/null", in_folder("null"));
  std::filesystem::create_symlink("/dev/full", in_folder("full"));
  write_whole_file(in_folder("null"), "x");
  EXPECT_THROW(write_whole_file(in_folder("full"), "x"), OutputError);
  EXPECT_TRUE(std::filesystem::is_symlink(in_folder("null")));
  ASSERT_EQ(mkfifo(in_folder("fifo").c_str(), 0600), 0);
  const int reader = open(in_folder("fifo").c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC);
  write_whole_file(in_folder("fifo"), "through");
  std::array<char, 16> bytes{};
  EXPECT_EQ(read(reader, bytes.data(), bytes.size()), 7);
  EXPECT_STREQ(bytes.data(), "through");
  close(reader);
  EXPECT_TRUE(std::filesystem::is_fifo(in_folder("fifo")));
  EXPECT_THROW(write_whole_file(directory.path().string(), "x"), OutputError) << "a folder";
  EXPECT_EQ(entries(directory.path()), 3U) << "no part of a file";
}

TEST(MakeFolder, MakesWhatIsMissingAbove) {
  const TemporaryDirectory directory;
  const std::string folder = (directory.path() / "new" / "deeper").string();
  make_folder(folder, "--output");
  make_folder(folder, "--output");
  write_whole_file(folder + "/text", "two\nlines\n");
  EXPECT_EQ(content(folder + "/text"), "two\nlines\n");
}

TEST(MakeFolder, RefusesAFile) {
  const TemporaryDirectory directory;
  const std::string path = (directory.path() / "file").string();
  write_whole_file(path, "x");
  EXPECT_THROW(make_folder(path, "--output"), InputError);
  EXPECT_THROW(make_folder(path + "/below", "--output"), InputError);
  EXPECT_THROW(write_whole_file(path + "/below", "x"), OutputError);
}

TEST(RequireNoInput, RefusesEveryPathToAFileThatIsRead) {
  const TemporaryDirectory directory;
  const auto in_folder = [&](const char* name) { return (directory.path() / name).string(); };
  const std::string input = in_folder("input"), hard = in_folder("hard"), soft = in_folder("soft");
  write_whole_file(input, "x");
  std::filesystem::create_hard_link(input, hard);
  std::filesystem::create_symlink(input, soft);
  for (const std::string& path : {input, hard, soft})
    EXPECT_THROW(require_no_input(path, "--csv", "the table", {"", input}), InputError);
  EXPECT_NO_THROW(
      require_no_input(in_folder("other"), "--csv", "the table", {"", input, "/dev/null"}));
  EXPECT_NO_THROW(require_no_input("/dev/null", "--csv", "the table", {"/dev/null"}))
      << "a device is not replaced";
}

TEST(GiveFinalName, NeverReplacesAFile) {
  const TemporaryDirectory directory;
  const std::string active = (directory.path() / "a.active").string(),
                    path = (directory.path() / "a").string();
  write_whole_file(active, "mine");
  write_whole_file(path, "another's");
  EXPECT_THROW(give_final_name(active, path), OutputError);
  EXPECT_EQ(content(path), "another's");
  std::filesystem::remove(path);
  give_final_name(active, path);
  EXPECT_EQ(content(path), "mine");
  EXPECT_FALSE(std::filesystem::exists(active));
}

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
  // Each says that it has its lock, and keeps it until all have one.
  int has_lock[2], all_have[2];
  ASSERT_EQ(pipe(has_lock), 0);
  ASSERT_EQ(pipe(all_have), 0);
  for (int k = 0; k < kProcesses; ++k) {
    if (fork() != 0) continue;
    close(all_have[1]);
    for (int number = 0;; ++number) {
      const auto lock = LockFile::create(path_ + std::to_string(number));
      if (!lock) continue;
      std::ofstream((directory_.path() / "log").string() + std::to_string(number), std::ios::app)
          << "x";
      char byte = 'x';
      const bool is_told = write(has_lock[1], &byte, 1) == 1;
      _exit(is_told && read(all_have[0], &byte, 1) == 0 ? 0 : 1);
    }
  }
  char bytes[kProcesses];
  for (int told = 0; told < kProcesses;) {
    const ssize_t count = read(has_lock[0], bytes, sizeof bytes);
    ASSERT_GT(count, 0);
    told += static_cast<int>(count);
  }
  for (const int end : {has_lock[0], has_lock[1], all_have[0], all_have[1]}) close(end);
  for (int k = 0; k < kProcesses; ++k) waitpid(-1, nullptr, 0);
  for (int number = 0; number < kProcesses; ++number)
    EXPECT_EQ(
        std::filesystem::file_size((directory_.path() / "log").string() + std::to_string(number)),
        1U)
        << number;
}

}  // namespace

}  // namespace codesign
