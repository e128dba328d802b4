// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "reading/study/study_fields.h"

#include "reading/study/study_fixture.h"

namespace codesign {
namespace {

YamlValue parse(const std::string& text) { return YamlValue::parse({"study.yaml", text}); }

std::string message_of(const std::string& text) {
  try {
    int count = 0;
    read_whole(parse(text), "count", 1, 10, &count);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(StudyFields, AMissingKeyChangesNothing) {
  int count = 7;
  SamplerKind sampler = SamplerKind::kRandom;
  std::uint32_t seed = 3;
  read_whole(parse("{}"), "count", 1, 10, &count);
  read_sampler(parse("{}"), &sampler, &seed);
  EXPECT_EQ(count, 7);
  EXPECT_EQ(sampler, SamplerKind::kRandom);
  EXPECT_EQ(seed, 3U);
}

TEST(StudyFields, ReadsWholeNumbersWithinARange) {
  int count = 0;
  read_whole(parse("count: 10"), "count", 1, 10, &count);
  EXPECT_EQ(count, 10);
  EXPECT_EQ(message_of("count: 1"), "");
  EXPECT_EQ(message_of("count: 0"), "study.yaml:1: count: count out of range (value: 0, allowed: a whole number from 1 to 10)");
  EXPECT_NE(message_of("count: 11").find("out of range"), std::string::npos);
  EXPECT_NE(message_of("count: 1e300").find("out of range"), std::string::npos);
  EXPECT_NE(message_of("count: 2.5").find("not an integer"), std::string::npos);
  EXPECT_NE(message_of("count: many").find("not a number"), std::string::npos);
}

TEST(StudyFields, ReadsSamplerAndSeed) {
  SamplerKind sampler = SamplerKind::kSobol;
  std::uint32_t seed = 1;
  read_sampler(parse("{sampler: latin_hypercube, seed: 2147483647}"), &sampler, &seed);
  EXPECT_EQ(sampler, SamplerKind::kLatinHypercube);
  EXPECT_EQ(seed, 2147483647U);
  EXPECT_THROW(read_sampler(parse("{seed: -1}"), &sampler, &seed), InputError);
  EXPECT_THROW(read_sampler(parse("{seed: 2147483648}"), &sampler, &seed), InputError);
  EXPECT_THROW(read_sampler(parse("{sampler: sobel}"), &sampler, &seed), InputError);
}

}  // namespace
}  // namespace codesign
