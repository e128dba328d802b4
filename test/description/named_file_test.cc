// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "description/named_file.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "temporary_directory.h"

namespace codesign {
namespace {

FileAddress address_of(const std::string& file) {
  return {file, {"study.yaml", 4}, "uncertain.from"};
}

TEST(NamedFile, IsInTheFolderOfTheStudy) {
  EXPECT_EQ(path_of(address_of("a.json"), "/studies"), "/studies/a.json");
  EXPECT_EQ(path_of(address_of("../a.json"), "/studies/one"), "/studies/a.json");
  EXPECT_EQ(path_of(address_of("/elsewhere/a.json"), ""), "/elsewhere/a.json");
  try {
    path_of(address_of("a.json"), "");
    ADD_FAILURE() << "accepted";
  } catch (const InputError& error) {
    EXPECT_EQ(error.fault().where.line, 4);
    EXPECT_EQ(error.fault().element, "uncertain.from");
    EXPECT_NE(error.fault().message.find("parameter server"), std::string::npos);
  }
}

TEST(NamedFile, IsReadBesideTheStudy) {
  const TemporaryDirectory folder;
  std::ofstream(folder.path() / "a.json") << "text";
  const FileLoader files = files_beside((folder.path() / "study.yaml").string());
  EXPECT_EQ(files(address_of("a.json")).text, "text");
  try {
    files(address_of("b.json"));
    ADD_FAILURE() << "accepted";
  } catch (const InputError& error) {
    EXPECT_EQ(error.fault().where.file, "study.yaml");
    EXPECT_NE(error.fault().value.find("b.json"), std::string::npos);
    EXPECT_NE(error.fault().message.find("no such file"), std::string::npos);
  }
}

}  // namespace
}  // namespace codesign
