// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "jobs/journal_header.h"

#include <gtest/gtest.h>

#include "ensemble/ensemble_fixture.h"
#include "jobs/edited_line.h"
#include "jobs/json.h"

namespace codesign {
namespace {

std::string header_of(const Problem& problem) { return journal_header(problem, problem.optimizer_options()); }

TEST(JournalHeader, IsTheSameForTheSameJob) { EXPECT_EQ(header_difference(header_of(block("")), header_of(block(""))), ""); }

TEST(JournalHeader, SaysWhatDiffers) {
  const Problem problem = block("");
  const std::string own = header_of(problem);
  EXPECT_EQ(header_difference(header_of(block("multistart: {starts: 2}\n")), own).find("the study differs"), 0u);
  EXPECT_NE(header_difference(header_of(with_settings(problem, {{"mu", 0.4}})), own).find("--set"), std::string::npos);
  OptimizerOptions options = problem.optimizer_options();
  options.max_evaluations += 1;
  EXPECT_NE(header_difference(journal_header(problem, options), own).find("options of the optimizer"), std::string::npos);
  Study study = problem.study();
  study.tuned.pop_back();
  EXPECT_NE(header_difference(header_of(with_study(problem, study)), own).find("tuned parameters"), std::string::npos);
}

TEST(JournalHeader, KnowsTheTrajectoriesInBags) {
  const auto header = [](double end) {
    const Problem plain = block("");
    std::string study = plain.study_text().text;
    const std::string setpoint = "setpoint: 0.5";
    study.replace(study.find(setpoint), setpoint.size(), "setpoint: {type: trajectory, bag: a.bag, topic: t, joint: slide}");
    const auto loader = [end](const TrajectoryAddress&) { return RecordedTrajectory{{0.0, 0.5}, {0.0, end}, {}, {}}; };
    return header_of(load_problem(plain.urdf(), {}, {"block.yaml", study}, {}, loader));
  };
  EXPECT_EQ(header_difference(header(0.5), header(0.5)), "");
  EXPECT_EQ(header_difference(header(0.5), header(0.6)).find("the recorded trajectories that the study names differ"), 0u);
}

TEST(JournalHeader, KnowsTheContentsOfFiles) {
  const auto header = [](const std::string& path, double variance) {
    const Problem plain = block("");
    const auto files = [&](const FileAddress&) {
      return SourceText{
          path, "{names: [mu], covariance: [[" + std::to_string(variance) + "]], identified: {mu: {value: 0.3, determined: true}}}"};
    };
    const std::string study = plain.study_text().text + "uncertain: {from: i.json}\n";
    return header_of(load_problem(plain.urdf(), {}, {"block.yaml", study}, {}, {}, files));
  };
  EXPECT_EQ(header_difference(header("a.json", 0.01), header("b.json", 0.01)), "") << "the place does not count";
  EXPECT_EQ(header_difference(header("a.json", 0.01), header("a.json", 0.02)).find("the contents of the files that the study names differ"),
            0u);
}

TEST(JournalHeader, RefusesOtherVersionsAndOtherFiles) {
  const std::string own = header_of(block(""));
  const auto set = [&own](const char* key, const Json& value) { return edited_line(own, [&](Json* line) { (*line)[key] = value; }); };
  EXPECT_NE(header_difference(set("version", "0.0.1"), own).find("version \"0.0.1\""), std::string::npos);
  EXPECT_NE(header_difference(set("journal", 3), own).find("format 3"), std::string::npos);
  EXPECT_NE(header_difference("{\"journal\":1,\"version\":\"0.1.0\"}", own).find("format 1"), std::string::npos) << "it had no checksums";
  for (const char* text : {"", "time,x", "{}", "[1]"})
    EXPECT_NE(header_difference(text, own).find("not the journal"), std::string::npos) << text;
  EXPECT_NE(header_difference(set("more", 1), own), "");
}

TEST(JournalHeader, RefusesADamagedLine) {
  const std::string own = header_of(block(""));
  std::string flipped = own;
  flipped[own.find("\"study\":\"") + 9] ^= 1;
  const std::string deep = "{\"journal\":" + std::string(1000000, '[');
  for (const std::string& text : {flipped, own.substr(0, own.size() - 1), with_checksum("{\"journal\":2,}"), deep})
    EXPECT_NE(header_difference(text, own).find("line 1 is damaged"), std::string::npos) << text.substr(0, 100);
}

}  // namespace
}  // namespace codesign
