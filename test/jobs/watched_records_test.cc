// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "jobs/watched_records.h"

#include <gtest/gtest.h>

namespace codesign {
namespace {

TEST(WatchedRecords, NameSignalsWithTheirRanges) {
  OptimizationResult result;
  Json object;
  add_watched(result, &object);
  EXPECT_TRUE(object.is_null());
  WatchedResult& watched = result.watched.emplace_back();
  watched.element = "path[0]";
  watched.signal = "hinge/effort";
  watched.largest = 2.5;
  watched.violation = 0.5;
  add_watched(result, &object);
  EXPECT_EQ(object["signals"][0]["signal"], "hinge/effort");
  EXPECT_EQ(object["signals"][0]["largest"], 2.5);
  EXPECT_EQ(object["signals"][0]["violation"], 0.5);
  const std::vector<std::string> sentences = watched_sentences(result);
  ASSERT_EQ(sentences.size(), 1U);
  EXPECT_NE(sentences[0].find("beyond its bounds by 0.5"), std::string::npos) << sentences[0];
}

}  // namespace
}  // namespace codesign
