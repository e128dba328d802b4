// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "mechanism_codesign/source_text.h"

#include <gtest/gtest.h>

#include <fstream>

#include "mechanism_codesign/error.h"
#include "temporary_directory.h"

namespace codesign {
namespace {

std::string complaint_about(const std::string& path) {
  try {
    read_source(path);
    return "";
  } catch (const InputError& error) {
    EXPECT_EQ(error.fault().where.file, path);
    return error.fault().message;
  }
}

TEST(SourceText, HasThePathAsItsName) {
  const TemporaryDirectory folder;
  const std::string path = (folder.path() / "a.urdf").string();
  std::ofstream(path) << "<robot/>\n";
  const SourceText text = read_source(path);
  EXPECT_EQ(text.name, path);
  EXPECT_EQ(text.text, "<robot/>\n");
}

TEST(SourceText, WhatIsNoFileIsNamed) {
  const TemporaryDirectory folder;
  EXPECT_NE(complaint_about((folder.path() / "none").string()).find("no such file"), std::string::npos);
  EXPECT_NE(complaint_about(folder.path().string()).find("folder"), std::string::npos);
  const std::string empty = (folder.path() / "empty").string();
  std::ofstream{empty};
  EXPECT_NE(complaint_about(empty).find("empty"), std::string::npos);
  EXPECT_NE(complaint_about("/dev/zero").find("too large"), std::string::npos) << "a device without end";
}

}  // namespace
}  // namespace codesign
