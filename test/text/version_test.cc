// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "mechanism_codesign/version.h"

#include <gtest/gtest.h>

#include <fstream>
#include <sstream>
#include <string>

#include "paths.h"

namespace codesign {
namespace {

TEST(Version, IsThatOfPackageXml) {
  std::ifstream file(source_dir() + "/package.xml");
  std::ostringstream text;
  text << file.rdbuf();
  EXPECT_NE(text.str().find("<version>" + std::string(version()) + "</version>"), std::string::npos)
      << version();
}

}  // namespace
}  // namespace codesign
