// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "cli/output_file.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <sstream>

#include "jobs/output_error.h"
#include "jobs/whole_file.h"
#include "mechanism_codesign/error.h"

namespace codesign::cli {
namespace {

std::string scratch(const std::string& name) {
  return (std::filesystem::path(testing::TempDir()) / ("output_file_" + name + "_" + std::to_string(getpid()))).string();
}

TEST(OutputFile, WritesWholeFilesIntoNewFolders) {
  const std::string folder = scratch("new");
  std::filesystem::remove_all(folder);
  make_folder(folder + "/deeper", "--output");
  make_folder(folder + "/deeper", "--output");
  write_whole_file(folder + "/deeper/text", "two\nlines\n");
  std::ifstream file(folder + "/deeper/text");
  std::ostringstream text;
  text << file.rdbuf();
  EXPECT_EQ(text.str(), "two\nlines\n");
  std::filesystem::remove_all(folder);
}

TEST(OutputFile, NamesTheOptionAndThePath) {
  const std::string path = scratch("missing") + "/run.csv";
  std::ofstream file;
  try {
    open_output(path, "--csv", &file);
    ADD_FAILURE();
  } catch (const InputError& error) {
    EXPECT_EQ(error.fault().where.file, path);
    EXPECT_EQ(error.fault().element, "--csv");
  }
}

TEST(OutputFile, RefusesEveryPathToAFileThatIsRead) {
  const std::string input = scratch("input"), hard = scratch("hard"), soft = scratch("soft"), other = scratch("other");
  for (const std::string& path : {input, hard, soft, other}) std::filesystem::remove(path);
  write_whole_file(input, "x");
  std::filesystem::create_hard_link(input, hard);
  std::filesystem::create_symlink(input, soft);
  for (const std::string& path : {input, hard, soft}) EXPECT_THROW(require_no_input(path, "--csv", "the table", {"", input}), InputError);
  EXPECT_NO_THROW(require_no_input(other, "--csv", "the table", {"", input, "/dev/null"}));
  EXPECT_NO_THROW(require_no_input("/dev/null", "--csv", "the table", {"/dev/null"})) << "a device is not replaced";
  for (const std::string& path : {input, hard, soft}) std::filesystem::remove(path);
}

TEST(OutputFile, RefusesAFolderThatIsAFile) {
  const std::string path = scratch("file");
  write_whole_file(path, "x");
  EXPECT_THROW(make_folder(path, "--output"), InputError);
  EXPECT_THROW(make_folder(path + "/below", "--output"), InputError);
  EXPECT_THROW(write_whole_file(path + "/below", "x"), OutputError);
  std::filesystem::remove(path);
}

}  // namespace
}  // namespace codesign::cli
