// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include "cli/run_fixture.h"
#include "jobs/json.h"
#include "mechanism_codesign/version.h"

namespace codesign::cli {
namespace {

const std::string kModel = shipped("urdf/slider_crank.urdf");
const std::string kStudy = shipped("config/slider_crank.yaml");

TEST(Run, HelpGoesToStandardOutput) {
  for (const char* word : {"help", "--help", "-h"}) {
    const Outcome outcome = run_words({word});
    EXPECT_EQ(outcome.code, kDone);
    EXPECT_NE(outcome.out.find("usage: codesign COMMAND"), std::string::npos);
    EXPECT_EQ(outcome.err, "");
  }
}

TEST(Run, HelpOfACommandIsItsOwn) {
  for (const std::vector<std::string>& words :
       {std::vector<std::string>{"help", "simulate"}, {"simulate", "--help"}}) {
    const Outcome outcome = run_words(words);
    EXPECT_EQ(outcome.code, kDone);
    EXPECT_NE(outcome.out.find("--samples"), std::string::npos);
    EXPECT_NE(outcome.out.find("--overlay"), std::string::npos) << "options of every command";
    EXPECT_EQ(outcome.out.find("--verify"), std::string::npos);
  }
  const Outcome unknown = run_words({"help", "simulat"});
  EXPECT_EQ(unknown.code, kBadInput);
  EXPECT_NE(unknown.err.find("did you mean \"simulate\"?"), std::string::npos);
}

TEST(Run, WarningsShowTheirCodeAndQuietLeavesOutProgress) {
  const ScratchFolder folder;
  const std::string study =
      folder.edited("study.yaml", read_text_file(kStudy),
                    "parameters:", "parameters:\n  unused: {initial: 1.0, lower: 0.0, upper: 2.0}");
  const std::string
      loud = run_words({"simulate", kModel, study, "--csv", folder.path("a.csv")}).err,
      quiet = run_words({"simulate", kModel, study, "--csv", folder.path("b.csv"), "--quiet"}).err;
  EXPECT_NE(loud.find("codesign simulate: warning [unused_parameter]: "), std::string::npos)
      << loud;
  EXPECT_NE(loud.find("of processor time"), std::string::npos);
  EXPECT_NE(quiet.find("warning [unused_parameter]: "), std::string::npos) << quiet;
  EXPECT_EQ(quiet.find("of processor time"), std::string::npos);
}

TEST(Run, PrintsItsVersion) {
  const Outcome outcome = run_words({"--version"});
  EXPECT_EQ(outcome.code, kDone);
  EXPECT_EQ(outcome.out, "codesign " + std::string(version()) + "\n");
  EXPECT_EQ(outcome.err, "");
}

TEST(Run, EveryJsonObjectHoldsTheVersion) {
  for (const std::string& model : {kModel, std::string("/nowhere/robot.urdf")})
    EXPECT_EQ(json_of(run_words({"check", model, "--json"}))["version"], version()) << model;
}

TEST(Run, BadUsageEndsWithTwo) {
  const Outcome outcome = run_words({"chek", kModel});
  EXPECT_EQ(outcome.code, kBadInput);
  EXPECT_EQ(outcome.out, "");
  EXPECT_NE(outcome.err.find("did you mean \"check\"?"), std::string::npos);
  EXPECT_NE(outcome.err.find("usage: codesign"), std::string::npos);
  EXPECT_EQ(json_of(run_words({"chek", kModel, "--json"}))["error"]["code"], "bad_usage");
}

TEST(Run, AFileThatIsNotThereIsBadInput) {
  const Outcome outcome = run_words({"check", "/nowhere/robot.urdf", "--json"});
  EXPECT_EQ(outcome.code, kBadInput);
  EXPECT_NE(outcome.err.find("/nowhere/robot.urdf"), std::string::npos);
  EXPECT_EQ(json_of(outcome)["error"]["file"], "/nowhere/robot.urdf");
}

TEST(Run, AMisspeltStudyKeyIsNamedWithFileAndLine) {
  const ScratchFolder folder;
  const std::string study =
      folder.edited("study.yaml", read_text_file(kStudy), "duration:", "duratoin:");
  const Outcome outcome = run_words({"gradient", kModel, study, "--json"});
  EXPECT_EQ(outcome.code, kBadInput);
  Json error = json_of(outcome)["error"];
  EXPECT_EQ(error["file"], study);
  EXPECT_EQ(error["line"], 3);
  EXPECT_EQ(error["element"], "duratoin");
  EXPECT_NE(outcome.err.find("did you mean \"duration\"?"), std::string::npos);
}

TEST(Run, ASettingMustNameAParameterAndKeepItsBounds) {
  const Outcome unknown = run_words({"check", kModel, kStudy, "--set", "crank_lenght=0.07"});
  EXPECT_EQ(unknown.code, kBadInput);
  EXPECT_NE(unknown.err.find("did you mean \"crank_length\"?"), std::string::npos);
  const Outcome outside = run_words({"check", kModel, kStudy, "--set", "crank_length=0.2"});
  EXPECT_EQ(outside.code, kBadInput);
  EXPECT_NE(outside.err.find("[0.06, 0.1]"), std::string::npos);
}

TEST(Run, ASignalMustExist) {
  const Outcome outcome =
      run_words({"simulate", kModel, kStudy, "--signals", "crank_joint/velocty"});
  EXPECT_EQ(outcome.code, kBadInput);
  EXPECT_EQ(outcome.out, "");
  EXPECT_NE(outcome.err.find("did you mean \"velocity\"?"), std::string::npos);
}

TEST(Run, ATuningCommandNeedsSomethingToTune) {
  const ScratchFolder folder;
  const std::string study = folder.path("study.yaml");
  std::ofstream(study) << "duration: 1\nobjective: {integral: [{signal: crank_joint/velocity}]}\n";
  for (const char* command : {"gradient", "optimize"}) {
    const Outcome outcome = run_words({command, kModel, study});
    EXPECT_EQ(outcome.code, kBadInput);
    EXPECT_NE(outcome.err.find("tunes no parameter"), std::string::npos) << outcome.err;
  }
}

TEST(Run, OutputThatCannotBeWrittenIsRefusedBeforeTheWork) {
  EXPECT_EQ(run_words({"simulate", kModel, kStudy, "--csv", "/nowhere/run.csv"}).code, kBadInput);
  EXPECT_EQ(run_words({"optimize", kModel, kStudy, "--output", "/dev/null/folder"}).code,
            kBadInput);
}

}  // namespace
}  // namespace codesign::cli
