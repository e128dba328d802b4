// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "jobs/watched_records.h"

#include <gtest/gtest.h>

#include "jobs/json.h"

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
  EXPECT_TRUE(object["signals"][0]["lower"].is_null());
  EXPECT_FALSE(object["signals"][0].contains("largest_in")) << "one run alone";
  const std::vector<std::string> sentences = watched_sentences(result);
  ASSERT_EQ(sentences.size(), 1U);
  EXPECT_NE(sentences[0].find("beyond its bounds by 0.5"), std::string::npos) << sentences[0];
}

TEST(WatchedRecords, TellBoundsAndTheRunOfEachExtreme) {
  OptimizationResult result;
  WatchedResult& watched = result.watched.emplace_back();
  watched.lower = -2.0;
  watched.after = 0.1;
  watched.before = 0.8;
  watched.largest_scenario = 1;
  result.scenarios.resize(2);
  result.scenarios[0].sample = -1;
  result.scenarios[1].run = "loaded";
  result.scenarios[1].sample = 3;
  Json object;
  add_watched(result, &object);
  const Json& signal = object["signals"][0];
  EXPECT_EQ(signal["lower"], -2.0);
  EXPECT_TRUE(signal["upper"].is_null());
  EXPECT_EQ(signal["after"], 0.1);
  EXPECT_EQ(signal["before"], 0.8);
  EXPECT_EQ(signal["largest_in"], (Json{{"run", "loaded"}, {"sample", 4}}));
  EXPECT_EQ(signal["smallest_in"], (Json{{"run", ""}, {"sample", 0}}));
}

}  // namespace
}  // namespace codesign
