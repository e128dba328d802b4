// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "jobs/whole_file.h"

#include <gtest/gtest.h>

#include <fstream>
#include <iterator>

#include "jobs/output_error.h"
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

TEST(WholeFile, AFullDiskLeavesTheOldFileAndNoPart) {
  const TemporaryDirectory directory;
  const std::string path = (directory.path() / "a").string();
  write_whole_file(path, "old");
  // A part that is a link to a full device stands for a full disk.
  std::filesystem::create_symlink("/dev/full", path + kPartSuffix);
  EXPECT_THROW(write_whole_file(path, "new"), OutputError);
  EXPECT_EQ(content(path), "old");
  EXPECT_FALSE(std::filesystem::exists(std::filesystem::symlink_status(path + kPartSuffix)));
}

TEST(GiveFinalName, NeverReplacesAFile) {
  const TemporaryDirectory directory;
  const std::string active = (directory.path() / "a.active").string(), path = (directory.path() / "a").string();
  write_whole_file(active, "mine");
  write_whole_file(path, "another's");
  EXPECT_THROW(give_final_name(active, path), OutputError);
  EXPECT_EQ(content(path), "another's");
  std::filesystem::remove(path);
  give_final_name(active, path);
  EXPECT_EQ(content(path), "mine");
  EXPECT_FALSE(std::filesystem::exists(active));
}

}  // namespace
}  // namespace codesign
