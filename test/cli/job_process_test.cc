// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
// The command line as a separate process: killed, interrupted, two at the same time, and with a
// full disk.
#include <gtest/gtest.h>

#include "child_process.h"
#include "cli/slider_crank.h"
#include "jobs/json.h"

namespace codesign::cli {
namespace {

class JobProcess : public testing::Test {
 protected:
  std::vector<std::string> optimize(const std::string& study) const {
    return {codesign_executable(), "optimize", kModel, study, "--output", folder_.path("job")};
  }
  std::string long_study() const {
    const std::string path =
        folder_.edited("long.yaml", read_text_file(kStudy), "duration: 2.0", "duration: 16.0");
    return folder_.edited("long.yaml", read_text_file(path), "relative_tolerance: 1.0e-6",
                          "relative_tolerance: 1.0e-9");
  }
  std::string job(const std::string& name) const { return folder_.path("job/" + name); }
  bool has(const std::string& name) const { return std::filesystem::exists(job(name)); }

  ScratchFolder folder_;
};

TEST_F(JobProcess, AKilledOneLeavesItsBestPointAndNothingHalfWritten) {
  ChildProcess process(optimize(long_study()));
  ASSERT_TRUE(comes_true([&] { return has("best.json"); }));
  process.send(SIGKILL);
  EXPECT_EQ(process.wait(), -SIGKILL);
  for (const char* name : {"result.json", "tuned.urdf", "initial.csv", "tuned.csv"})
    EXPECT_FALSE(has(name)) << name;
  const Json best = Json::parse(read_text_file(job("best.json")));
  const Json model = json_of(run_words({"check", job("best.urdf"), "--json"}));
  EXPECT_GT(best["objective"].get<double>(), 0.0);
  EXPECT_EQ(model["parameters"].size() + 1, best["parameters"].size());

  ChildProcess next(optimize(short_study(folder_)), "/dev/null", folder_.path("err"));
  EXPECT_EQ(next.wait(), kDone);
  EXPECT_NE(read_text_file(folder_.path("err")).find("killed_best.json"), std::string::npos);
  EXPECT_EQ(Json::parse(read_text_file(job("killed_best.json"))), best);
  EXPECT_TRUE(has("result.json"));
  EXPECT_FALSE(has("best.json"));
}

TEST_F(JobProcess, OneFolderTakesOneOptimizationAtATime) {
  ChildProcess first(optimize(long_study()));
  ASSERT_TRUE(comes_true([&] { return has("best.json"); }));
  ChildProcess second(optimize(short_study(folder_)), "/dev/null", folder_.path("err"));
  EXPECT_EQ(second.wait(), kBadInput);
  EXPECT_NE(read_text_file(folder_.path("err")).find("another optimization"), std::string::npos);
  first.send(SIGINT);
  EXPECT_EQ(first.wait(), kFailed);
  EXPECT_TRUE(has("tuned.csv"));
  EXPECT_FALSE(has("best.json"));
}

TEST_F(JobProcess, InterruptedBeforeTheFirstEvaluationItLeavesTheStart) {
  const Outcome outcome =
      run_words({"optimize", kModel, kStudy, "--json", "--output", folder_.path("job")}, true);
  EXPECT_EQ(outcome.code, kFailed);
  const Json object = json_of(outcome);
  EXPECT_EQ(object["termination"], "cancelled");
  EXPECT_FALSE(object.contains("objective"));
  EXPECT_EQ(object["parameters"], object["initial_parameters"]);
  EXPECT_EQ(lines_of(read_text_file(job("tuned.csv"))).size(), 502U);
  EXPECT_EQ(lines_of(read_text_file(job("convergence.csv"))).size(), 1U);
}

TEST_F(JobProcess, OutputThatIsLostIsAFailureOfEveryCommand) {
  const std::vector<std::vector<std::string>> commands = {
      {"check"},    {"simulate"}, {"simulate", "--json"}, {"gradient"}, {"gradient", "--json"},
      {"optimize"}, {"help"}};
  for (std::vector<std::string> words : commands) {
    const std::string command = words[0];
    words.insert(words.begin(), codesign_executable());
    if (command != "help") words.insert(words.begin() + 2, {kModel, short_study(folder_)});
    ChildProcess process(words, "/dev/full", folder_.path(command));
    EXPECT_EQ(process.wait(), kFailed) << command;
    EXPECT_NE(read_text_file(folder_.path(command)).find("standard output: cannot be written"),
              std::string::npos)
        << command;
  }
}

TEST_F(JobProcess, ACsvThatIsLostIsAFailure) {
  const Outcome outcome =
      run_words({"simulate", kModel, short_study(folder_), "--csv", "/dev/full"});
  EXPECT_EQ(outcome.code, kFailed);
  EXPECT_NE(outcome.err.find("/dev/full: cannot be written: No space left on device"),
            std::string::npos)
      << outcome.err;
}

TEST_F(JobProcess, WithoutRoomItKeepsWhatFitsAndNamesWhatDoesNot) {
  // 12 kB are enough for tuned.urdf and result.json, not for the runs.
  std::vector<std::string> words = optimize(short_study(folder_));
  words.emplace_back("--json");
  ChildProcess process(words, folder_.path("out"), folder_.path("err"), 12000);
  EXPECT_EQ(process.wait(), kFailed);
  const std::string err = read_text_file(folder_.path("err"));
  for (const char* name : {"initial.csv", "tuned.csv"}) {
    EXPECT_NE(err.find(job(name) + ": cannot be written: File too large"), std::string::npos)
        << err;
    EXPECT_FALSE(has(name)) << name;
    EXPECT_FALSE(has(std::string(name) + ".part")) << name;
  }
  for (const char* name : {"tuned.urdf", "result.json", "convergence.csv"})
    EXPECT_TRUE(has(name)) << name;
  const Json object = Json::parse(read_text_file(folder_.path("out")));
  EXPECT_TRUE(object.contains("objective"));
  EXPECT_EQ(object["error"]["code"], "output_failed");
  for (const char* name : {"initial.csv", "tuned.csv"})
    EXPECT_NE(object["error"]["message"].get<std::string>().find(job(name) + ": cannot be written"),
              std::string::npos)
        << object["error"];
}

TEST_F(JobProcess, ANameThatIsNoUtf8LosesNothing) {
  const std::string model = folder_.edited("model.urdf", read_text_file(kModel),
                                           "name=\"slider_crank\"", "name=\"cr\xe4nk\"");
  const Outcome outcome = run_words(
      {"optimize", model, short_study(folder_), "--json", "--output", folder_.path("job")});
  if (outcome.code == kBadInput) GTEST_SKIP() << "the reader refuses it: " << outcome.err;
  EXPECT_EQ(outcome.code, kDone) << outcome.err;
  EXPECT_EQ(Json::parse(read_text_file(job("result.json"))), json_of(outcome));
  EXPECT_TRUE(has("tuned.csv"));
}

}  // namespace
}  // namespace codesign::cli
