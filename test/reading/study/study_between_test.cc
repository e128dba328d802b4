// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "reading/study/study_between.h"

#include <gtest/gtest.h>

namespace codesign {
namespace {

Between read(const std::string& text) {
  return read_between(YamlValue::parse({"study.yaml", text}), ParameterTable({{"a", 2.0, 0.0, 5.0, "", {}}}));
}

TEST(StudyBetween, ReadsOneOrTwoBounds) {
  EXPECT_EQ(read("between: [-1, \"${3*a}\"]").lower->nominal(), -1.0);
  EXPECT_EQ(read("between: [-1, \"${3*a}\"]").upper->nominal(), 6.0);
  EXPECT_EQ(read("at_least: 1").lower->nominal(), 1.0);
  EXPECT_FALSE(read("at_least: 1").upper);
  EXPECT_EQ(read("{at_least: 1, at_most: 4}").upper->nominal(), 4.0);
}

TEST(StudyBetween, NeedsThemInOneForm) {
  for (const char* text : {"{}", "{between: [1, 2], at_most: 3}", "{between: [1]}", "{at_most: b}"})
    EXPECT_THROW(read(text), InputError) << text;
}

}  // namespace
}  // namespace codesign
