// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "cli/usage.h"

#include <gtest/gtest.h>

#include <sstream>

namespace codesign::cli {
namespace {

TEST(Usage, NamesEveryCommandAndOption) {
  for (const char* word : {"check MODEL", "urdf MODEL", "--sticks", "simulate MODEL STUDY", "gradient MODEL STUDY", "optimize MODEL STUDY",
                           "--signals", "--csv", "--samples", "--verify", "--output", "--resume", "report DIR|BAG", "apply DIR|BAG",
                           "--overlay", "--result", "--set", "--json", "--version"})
    EXPECT_NE(usage().find(word), std::string::npos) << word;
}

TEST(Usage, FitsATerminalAndEndsItsLastLine) {
  std::istringstream lines(usage());
  for (std::string line; std::getline(lines, line);) EXPECT_LE(line.size(), 100U) << line;
  EXPECT_EQ(usage().back(), '\n');
}

}  // namespace
}  // namespace codesign::cli
