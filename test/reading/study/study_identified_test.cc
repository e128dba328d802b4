// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "reading/study/study_blocks.h"

#include <cmath>

#include "description/study.h"
#include "reading/study/study_fixture.h"

namespace codesign {
namespace {

// Lines 1 to 3; `uncertain:` begins in line 4.
const std::string kHead = kLeastStudy +
                          "parameters: {Kp: {initial: 1.0}, mu: {initial: 0.3, lower: 0, upper: "
                          "0.35, tune: false}, mass: {initial: 1, tune: false}}\n";

/// A file as `codesign identify` writes it: a parameter that no recording determines, a number of a
/// sensor, and two correlated parameters.
std::string found() {
  return R"({
  "version": "1.0.0",
  "identified": {
    "mass": {"value": 1.25, "deviation": 0.3, "determined": true, "on_bound": false, "interval": [0.65, 1.85]},
    "crank_joint/offset": {"value": 7.0, "deviation": 2.0, "determined": true, "on_bound": false, "interval": [3.0, 11.0]},
    "mu": {"value": 0.31, "deviation": 0.02, "determined": true, "on_bound": false, "interval": [0.27, 0.35]},
    "crank_length": {"value": 0.08, "deviation": null, "determined": false, "on_bound": false, "interval": [null, null]}
  },
  "names": ["mass", "crank_joint/offset", "mu", "crank_length"],
  "covariance": [
    [0.09, 0.1, 0.0036, null],
    [0.1, 4.0, 0.01, null],
    [0.0036, 0.01, 0.0004, null],
    [null, null, null, null]
  ]
})";
}

Study read_with(const std::string& uncertain, const std::string& json = found(),
                std::string* file = nullptr) {
  const FileLoader files = [&](const FileAddress& address) {
    if (file)
      *file = address.file + " " + address.element + ":" + std::to_string(address.where.line);
    return SourceText{"folder/identification.json", json};
  };
  return read_study({"study.yaml", kHead + "uncertain: " + uncertain + "\n"}, study_robot(), {},
                    files);
}

InputFault refusal(const std::string& uncertain, const std::string& json = found()) {
  try {
    read_with(uncertain, json);
  } catch (const InputError& error) {
    return error.fault();
  }
  ADD_FAILURE() << "accepted: " << uncertain;
  return {};
}

const char kExcept[] = "{from: {file: identification.json, except: [crank_length]}}";

std::string with(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

TEST(StudyIdentified, ReadsADistributionWithItsCorrelations) {
  std::string file;
  const std::vector<UncertainQuantity> quantities =
      read_with(kExcept, found(), &file).ensemble.uncertain;
  EXPECT_EQ(file, "identification.json uncertain.from.file:4");
  ASSERT_EQ(quantities.size(), 2U) << "neither the number of the sensor nor the exception";
  EXPECT_EQ(quantities[0].name, "mass");
  EXPECT_EQ(quantities[1].name, "mu");
  EXPECT_EQ(quantities[1].parameter, 3);
  EXPECT_EQ(quantities[1].where.line, 4);
  EXPECT_TRUE(quantities[0].is_identified);
  const Distribution& mass = quantities[0].distribution;
  EXPECT_EQ(mass.kind, DistributionKind::kNormal);
  EXPECT_EQ(mass.mean, 1.25);
  EXPECT_DOUBLE_EQ(mass.deviation, 0.3);
  EXPECT_TRUE(std::isinf(mass.upper));
  const Distribution& mu = quantities[1].distribution;
  EXPECT_EQ(mu.mean, 0.31);
  EXPECT_EQ(mu.upper, 0.35) << "the bound of the study";
  EXPECT_NEAR(mu.deviation, 0.02 * 0.8, 1e-15)
      << "given the mass, with which it has a correlation of 0.6";
  EXPECT_DOUBLE_EQ(quantities[1].spread, 0.02);
  ASSERT_EQ(quantities[1].slopes.size(), 1U);
  EXPECT_EQ(quantities[1].slopes[0].quantity, 0U);
  EXPECT_DOUBLE_EQ(quantities[1].slopes[0].slope, 0.04);
}

TEST(StudyIdentified, StandsBesideOtherDistributions) {
  const std::vector<UncertainQuantity> quantities =
      read_with(
          "{rod_length: {uniform: [0.2, 0.3]}, from: identification.json, crank_length: {normal: "
          "[0.08, 0.01]}}")
          .ensemble.uncertain;
  ASSERT_EQ(quantities.size(), 4U);
  EXPECT_EQ(quantities[0].name, "rod_length");
  EXPECT_EQ(quantities[2].slopes.at(0).quantity, 1U) << "indices count the entries before";
  EXPECT_EQ(quantities[3].name, "crank_length");
}

TEST(StudyIdentified, AskForWhatTheFileDoesNotTell) {
  const InputFault fault = refusal("{from: identification.json}");
  EXPECT_EQ(fault.where.file, "study.yaml");
  EXPECT_EQ(fault.where.line, 4);
  EXPECT_EQ(fault.element, "uncertain.from");
  EXPECT_NE(fault.message.find("did not determine crank_length"), std::string::npos);
  EXPECT_NE(fault.allowed.find("except: [crank_length]"), std::string::npos);
}

TEST(StudyIdentified, OneDistributionForEach) {
  EXPECT_NE(refusal("{from: {file: i.json, except: [crank_length]}, mu: {uniform: [0.1, 0.2]}}")
                .message.find("of its own"),
            std::string::npos);
  EXPECT_EQ(
      read_with("{from: {file: i.json, except: [crank_length, mu]}, mu: {uniform: [0.1, 0.2]}}")
          .ensemble.uncertain.size(),
      2U);
}

TEST(StudyIdentified, NamesThePlaceInTheFile) {
  const auto at = [](const InputFault& fault) {
    return fault.where.file + ":" + std::to_string(fault.where.line) + " " + fault.element;
  };
  InputFault fault =
      refusal(kExcept, with(found(), "\"mu\", \"crank_length\"]", "\"mus\", \"crank_length\"]"));
  EXPECT_EQ(at(fault), "folder/identification.json:3 identified.mus");
  std::string other = with(found(), "\"mu\", \"crank_length\"]", "\"mus\", \"crank_length\"]");
  fault = refusal(kExcept, with(other, "\"mu\": {", "\"mus\": {"));
  EXPECT_EQ(at(fault), "folder/identification.json:9 names[2]");
  EXPECT_NE(fault.message.find("did you mean \"mu\"?"), std::string::npos);
  fault = refusal(kExcept, with(found(), "0.0036, 0.01, 0.0004, null", "0.0036, 0.01, much, null"));
  EXPECT_EQ(at(fault), "folder/identification.json:13 covariance[2][2]");
  fault = refusal(kExcept, with(found(), "    [0.1, 4.0, 0.01, null],\n", ""));
  EXPECT_EQ(at(fault), "folder/identification.json:10 covariance");
  fault = refusal(kExcept, with(found(), "[0.0036, 0.01", "[0.0037, 0.01"));
  EXPECT_NE(fault.message.find("not symmetric"), std::string::npos);
  fault = refusal(
      kExcept, with(with(found(), "0.1, 0.0036", "0.1, 0.036"), "[0.0036, 0.01", "[0.036, 0.01"));
  EXPECT_NE(fault.message.find("no distribution has this covariance"), std::string::npos);
  fault = refusal(kExcept, with(found(), "{\"value\": 0.31", "{\"value\": 0.36"));
  EXPECT_EQ(at(fault), "folder/identification.json:6 identified.mu.value");
  EXPECT_NE(fault.allowed.find("0.35"), std::string::npos);
}

TEST(StudyIdentified, RefusesOtherFiles) {
  for (const char* text : {"[1, 2]", "{\"error\": 1}", "scalar"})
    EXPECT_NE(refusal(kExcept, text).message.find("not the result of an identification"),
              std::string::npos)
        << text;
  EXPECT_NE(refusal("{from: {file: i.json, except: [crank_length, mass, mu]}}")
                .message.find("nothing of the file"),
            std::string::npos);
  EXPECT_NE(refusal("{from: {file: i.json, except: [crank_lenght]}}")
                .message.find("did you mean \"crank_length\"?"),
            std::string::npos);
  EXPECT_NE(refusal("{from: {file: i.json, but: [mass]}}").message.find("unknown key"),
            std::string::npos);
  expect_fault(kHead + "uncertain: {from: i.json}\n", "uncertain.from", "no file can be read here",
               4);
}

TEST(StudyIdentified, WhatIsTunedOrSetIsNotUncertain) {
  const std::string tuned = with(kHead, "mass: {initial: 1, tune: false}", "mass: {initial: 1}");
  const FileLoader files = [](const FileAddress&) { return SourceText{"i.json", found()}; };
  const auto read = [&](const std::string& study) {
    read_study({"study.yaml", study}, study_robot(), {}, files);
  };
  try {
    read(tuned + "uncertain: " + kExcept + "\n");
    ADD_FAILURE() << "accepted";
  } catch (const InputError& error) {
    EXPECT_EQ(error.fault().element, "uncertain.from");
    EXPECT_NE(error.fault().message.find("the study tunes mass"), std::string::npos);
    EXPECT_EQ(error.fault().allowed, "except: [mass]");
  }
  EXPECT_NO_THROW(
      read(tuned + "uncertain: {from: {file: i.json, except: [crank_length, mass]}}\n"));
  EXPECT_THROW(read(kHead + "runs: {a: {set: {mu: 0.1}}}\nuncertain: " + kExcept + "\n"),
               InputError);
}

TEST(StudyIdentified, AParameterOfThatNameTakesPrecedence) {
  const std::string head =
      with(kHead, "Kp: {initial: 1.0}", "Kp: {initial: 1.0}, from: {initial: 1, tune: false}");
  const Study study =
      read_study({"study.yaml", head + "uncertain: {from: {uniform: [0, 1]}}\n"}, study_robot());
  EXPECT_EQ(study.ensemble.uncertain.at(0).name, "from");
}

}  // namespace
}  // namespace codesign
