// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "jobs/record_json.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace codesign {

/// A result with a field of each kind.
struct RecordedSample {
  std::string name, note;
  double value = 0.0, bound = 0.0;
  int count = 0;
  bool rises = false;
  std::vector<std::string> words;
  struct {
    int line = 0;
  } where;
};
constexpr auto fields_of(const RecordedSample*) {
  return std::make_tuple(
      field("name", &RecordedSample::name), field("value", &RecordedSample::value),
      field("bound",
            [](const RecordedSample& one) {
              return OrNull{one.bound, one.bound > 1e6};
            }),
      field("number", [](const RecordedSample& one) { return one.count + 1; }),
      word("direction", &RecordedSample::rises, "falling", "rising"),
      field("words", &RecordedSample::words),
      field(
          "line", [](auto& one) -> auto& { return one.where.line; }),
      field("note", [](const RecordedSample& one) { return unless_empty(one.note); }));
}

namespace {

RecordedSample sample() {
  RecordedSample one;
  one.name = "crank";
  one.value = 0.1;
  one.bound = 5.0;
  one.count = 3;
  one.rises = true;
  one.words = {"a", "b"};
  one.where.line = 7;
  return one;
}

TEST(RecordJson, HasTheFieldsInTheOrderOfTheirRows) {
  EXPECT_EQ(record_json(sample()).dump(),
            R"({"name":"crank","value":0.1,"bound":5.0,"number":4,"direction":"rising",)"
            R"("words":["a","b"],"line":7})");
  RecordedSample other = sample();
  other.bound = 1e7;
  other.note = "far";
  EXPECT_TRUE(record_json(other)["bound"].is_null());
  EXPECT_EQ(record_json(other)["note"], "far");
  EXPECT_EQ(records_json(std::vector<RecordedSample>{sample(), other}).size(), 2U);
}

TEST(RecordJson, WhatCanBeSetIsReadBackToTheLastBit) {
  RecordedSample one = sample();
  for (const double value : {0.1, -0.0, 5e-324, std::numeric_limits<double>::infinity()}) {
    one.value = value;
    const Json object = Json::parse(record_json<NonFinite::kText>(one).dump());
    const auto back = read_record<RecordedSample>(object);
    EXPECT_EQ(back.value, value);
    EXPECT_EQ(std::signbit(back.value), std::signbit(value));
    EXPECT_EQ(back.name, "crank");
    EXPECT_TRUE(back.rises);
    EXPECT_EQ(back.words, one.words);
    EXPECT_EQ(back.where.line, 7);
    EXPECT_EQ(back.count, 0) << "a number that is computed is not set";
  }
  one.value = std::nan("");
  EXPECT_TRUE(std::isnan(read_record<RecordedSample>(record_json<NonFinite::kText>(one)).value));
}

TEST(RecordJson, AnotherObjectIsRefused) {
  Json object = record_json(sample());
  object["direction"] = "sideways";
  EXPECT_THROW(read_record<RecordedSample>(object), std::invalid_argument);
  object = record_json(sample());
  object["value"] = "much";
  EXPECT_THROW(read_record<RecordedSample>(object), std::invalid_argument);
  object.erase("value");
  EXPECT_THROW(read_record<RecordedSample>(object), Json::exception);
}

}  // namespace
}  // namespace codesign
