// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <fstream>
#include <set>

#include "mechanism_codesign/error.h"
#include "mechanism_codesign/source_text.h"
#include "mechanism_codesign/status.h"
#include "mechanism_codesign/warning.h"
#include "temporary_directory.h"

namespace codesign {
namespace {

std::string text(const InputFault& fault) { return InputError(fault).what(); }

TEST(InputError, NamesFileLineElementValueAndAllowed) {
  EXPECT_EQ(text({{"a.urdf", 7}, "<mass>", "the mass is negative", "-1", "> 0"}),
            "a.urdf:7: <mass>: the mass is negative (value: -1, allowed: > 0)");
}

TEST(InputError, LeavesOutWhatIsNotKnown) {
  EXPECT_EQ(text({{"a.urdf", 0}, "", "the file cannot be read", "", ""}),
            "a.urdf: the file cannot be read");
  EXPECT_EQ(text({{"", 0}, "duration", "missing", "", ""}), "duration: missing");
  EXPECT_EQ(text({{"a", 1}, "b", "c", "d", ""}), "a:1: b: c (value: d)");
  EXPECT_EQ(text({{"a", 1}, "b", "c", "", "e"}), "a:1: b: c (allowed: e)");
}

TEST(InputError, KeepsTheParts) {
  const InputError error({{"a.urdf", 7}, "<mass>", "m", "-1", "> 0"});
  EXPECT_EQ(error.fault().where.line, 7);
  EXPECT_EQ(error.fault().value, "-1");
}

TEST(Warning, ReadsLikeAnErrorAboutTheSamePlace) {
  const InputFault fault{{"arm.urdf", 7},
                         "<limit>",
                         "lower is above upper, so that nothing is bounded",
                         "1 > -1",
                         "lower <= upper"};
  const Warning warning = warn("limit_order", fault);
  EXPECT_EQ(warning.code, "limit_order");
  EXPECT_EQ(warning.message, InputError(fault).what());
  EXPECT_EQ(warning.where.file, "arm.urdf");
  EXPECT_EQ(warning.where.line, 7);
}

TEST(Warning, IsKeptOnce) {
  Warnings warnings{{"a", "one", {}}};
  append({{"a", "one", {}}, {"a", "two", {}}, {"b", "one", {}}}, &warnings);
  ASSERT_EQ(warnings.size(), 3U);
  EXPECT_EQ(warnings[1].message, "two");
  EXPECT_EQ(warnings[2].code, "b");
}

std::string complaint_about(const std::string& path) {
  try {
    read_source(path);
    return "";
  } catch (const InputError& error) {
    EXPECT_EQ(error.fault().where.file, path);
    return error.what();
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
  const std::string absent = complaint_about((folder.path() / "none").string());
  for (const char* words : {"no such file", "one in a study in the folder of the study"})
    EXPECT_NE(absent.find(words), std::string::npos) << absent;
  EXPECT_NE(complaint_about(folder.path().string()).find("folder"), std::string::npos);
  const std::string empty = (folder.path() / "empty").string();
  std::ofstream{empty};
  EXPECT_NE(complaint_about(empty).find("empty"), std::string::npos);
  EXPECT_NE(complaint_about("/dev/zero").find("too large"), std::string::npos)
      << "a device without end";
}

TEST(Status, OnlySuccessIsOk) {
  EXPECT_TRUE(Status().ok());
  EXPECT_FALSE((Status{StatusCode::kCancelled, 0.5, "cancelled"}).ok());
}

TEST(Status, EveryCodeHasANameOfItsOwn) {
  std::set<std::string> names;
  const int last = static_cast<int>(StatusCode::kNonFiniteGradient);
  for (int code = 0; code <= last; ++code) names.insert(name_of(static_cast<StatusCode>(code)));
  EXPECT_EQ(names.size(), static_cast<std::size_t>(last) + 1);
  EXPECT_EQ(names.count("unknown"), 0U);
  EXPECT_STREQ(name_of(StatusCode::kAssemblyFailed), "assembly_failed");
  EXPECT_STREQ(name_of(StatusCode::kInvalidDesign), "invalid_design");
}

TEST(Sentences, NameCodeTimeAndCause) {
  const Status status{StatusCode::kTooManySteps, 0.25, "more than 7 steps"};
  EXPECT_EQ(describe(status), "too_many_steps at t = 0.25 s: more than 7 steps");
  EXPECT_EQ(describe({StatusCode::kCancelled, 1.0, ""}), "cancelled at t = 1 s");
  EXPECT_EQ(reason(status), "more than 7 steps (at t = 0.25 s)");
}

TEST(Sentences, WhatEndedASearchHasNoTimeOfARun) {
  EXPECT_EQ(reason({StatusCode::kCancelled, 0.0, "the best point so far is kept"}),
            "the best point so far is kept");
  EXPECT_EQ(describe({StatusCode::kInfeasible, 0.0, "outside its constraints"}),
            "infeasible: outside its constraints");
  EXPECT_EQ(reason({StatusCode::kAssemblyFailed, 0.0, "no way"}), "no way (at t = 0 s)");
}

}  // namespace

}  // namespace codesign
