// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <utility>

#include "cli/slider_crank.h"
#include "jobs/json.h"

namespace codesign::cli {
namespace {

TEST(OptimizeCommand, WritesItsFolder) {
  const ScratchFolder folder;
  const Outcome outcome = run_words(
      {"optimize", kModel, short_study(folder), "--json", "--output", folder.path("job")});
  ASSERT_EQ(outcome.code, kDone) << outcome.err;
  Json object = json_of(outcome);
  expect_keys(object, {"objective", "initial_objective", "gradient", "parameters",
                       "initial_parameters", "iterations", "evaluations", "termination", "steps",
                       "rejected_steps", "cpu_seconds", "counts"});
  EXPECT_LT(object["objective"].get<double>(), object["initial_objective"].get<double>());
  EXPECT_EQ(Json::parse(read_text_file(folder.path("job/result.json"))), object);
  const std::vector<std::string> convergence =
      lines_of(read_text_file(folder.path("job/convergence.csv")));
  EXPECT_EQ(
      convergence.at(0),
      "evaluation,iteration,status,objective,best_objective,gradient_norm,events,crank_length,"
      "rod_length,slider_length,slider_width,Kp");
  EXPECT_EQ(convergence.size(), 1U + object["evaluations"].get<std::size_t>());
  for (const char* name : {"job/initial.csv", "job/tuned.csv"})
    EXPECT_EQ(lines_of(read_text_file(folder.path(name))).size(), 502U) << name;
  Json tuned = json_of(run_words({"check", folder.path("job/tuned.urdf"), "--json"}));
  EXPECT_NEAR(tuned["parameters"]["crank_length"].get<double>(),
              object["parameters"]["crank_length"].get<double>(), 1e-15);
}

TEST(OptimizeCommand, TheFilesAloneReproduceTheObjective) {
  const ScratchFolder folder;
  ASSERT_EQ(run_words({"optimize", kModel, short_study(folder), "--set", "rod_length=0.31",
                       "--output", folder.path("job")})
                .code,
            kDone);
  const auto in_job = [&folder](const char* name) {
    return folder.path(std::string("job/") + name);
  };
  const Json result = Json::parse(read_text_file(in_job("result.json")));
  const auto objective = [&](const char* command, const char* model, const char* design) {
    const Outcome outcome = run_words(
        {command, in_job(model), in_job("job_study.yaml"), "--result", in_job(design), "--json"});
    EXPECT_EQ(outcome.code, kDone) << outcome.err;
    return json_of(outcome)["objective"].get<double>();
  };
  const double tuned = result["objective"].get<double>(),
               initial = result["initial_objective"].get<double>();
  for (const char* command : {"simulate", "gradient"}) {
    EXPECT_NEAR(objective(command, "tuned.urdf", "result.json"), tuned, 1e-12 * tuned) << command;
    EXPECT_NEAR(objective(command, "initial.urdf", "result.json"), tuned, 1e-12 * tuned) << command;
    EXPECT_NEAR(objective(command, "initial.urdf", "initial.json"), initial, 1e-12 * initial)
        << command;
  }
}

TEST(OptimizeCommand, RefusesToReplaceWhatItReads) {
  const ScratchFolder folder;
  const std::string model =
      folder.edited("initial.urdf", read_text_file(kModel), "crank_length", "crank_length");
  const std::string before = read_text_file(model);
  const Outcome outcome =
      run_words({"optimize", model, short_study(folder), "--output", folder.path(".")});
  EXPECT_EQ(outcome.code, kBadInput);
  EXPECT_NE(outcome.err.find("initial.urdf would replace this file"), std::string::npos)
      << outcome.err;
  EXPECT_EQ(read_text_file(model), before);
}

TEST(OptimizeCommand, ALinkInTheFolderIsReplacedAndNotWrittenThrough) {
  const ScratchFolder folder;
  const std::string kept = folder.edited("kept.txt", "kept", "k", "k");
  std::filesystem::create_directory(folder.path("job"));
  std::filesystem::create_symlink(kept, folder.path("job/convergence.csv"));
  const Outcome outcome =
      run_words({"optimize", kModel, short_study(folder), "--output", folder.path("job")});
  EXPECT_EQ(outcome.code, kDone) << outcome.err;
  EXPECT_EQ(read_text_file(kept), "kept");
  EXPECT_FALSE(std::filesystem::is_symlink(folder.path("job/convergence.csv")));
}

TEST(OptimizeCommand, ListsConstraintsWithTheirMargins) {
  const ScratchFolder folder;
  const std::string study =
      folder.edited("bounded.yaml", read_text_file(short_study(folder)), "objective:",
                    "constraints: [{peak: crank_joint/velocity, at_most: 20.0}, {expression: "
                    "\"${rod_length + crank_length}\", between: [0.1, 0.9]}]\nobjective:");
  const std::string path =
      folder.edited("slsqp.yaml", read_text_file(study), "algorithm: lbfgs", "algorithm: slsqp");
  const Outcome outcome = run_words({"optimize", kModel, path, "--json"});
  ASSERT_EQ(outcome.code, kDone) << outcome.err;
  Json object = json_of(outcome);
  ASSERT_EQ(object["constraints"].size(), 2U);
  const double sum = object["parameters"]["rod_length"].get<double>() +
                     object["parameters"]["crank_length"].get<double>();
  EXPECT_EQ(object["constraints"][0]["element"], "constraints[1]");
  EXPECT_EQ(object["constraints"][0]["constraint"], "rod_length + crank_length >= 0.1");
  EXPECT_NEAR(object["constraints"][0]["margin"].get<double>(), sum - 0.1, 1e-14);
  EXPECT_NEAR(object["constraints"][1]["margin"].get<double>(), 0.9 - sum, 1e-14);
  EXPECT_EQ(object["constraints"][1]["violation"], 0.0);
  ASSERT_EQ(object["signals"].size(), 1U);
  EXPECT_EQ(object["signals"][0]["element"], "constraints[0]");
  EXPECT_EQ(object["signals"][0]["signal"], "crank_joint/velocity");
}

TEST(OptimizeCommand, PrintsStartAndTunedDesign) {
  const ScratchFolder folder;
  const Outcome outcome = run_words({"optimize", kModel, short_study(folder)});
  ASSERT_EQ(outcome.code, kDone) << outcome.err;
  for (const std::string& name : kTuned)
    EXPECT_NE(outcome.out.find("\n" + name + " "), std::string::npos) << name;
  EXPECT_NE(outcome.out.find("max_evaluations_reached"), std::string::npos) << outcome.out;
  // A slow machine also tells its progress, once a second.
  const std::vector<std::string> lines = lines_of(outcome.err);
  EXPECT_EQ(
      std::count_if(lines.begin(), lines.end(),
                    [](const std::string& line) { return line.rfind("searching: ", 0) != 0; }),
      5)
      << outcome.err;
  EXPECT_NE(outcome.err.find("warning [max_evaluations_reached]: "), std::string::npos)
      << outcome.err;
  EXPECT_EQ(outcome.err.substr(0, 8), "trial 1:");
}

/// A stream that sets a flag once a given text is written to it, like a user who interrupts on
/// reading it.
class WatchingBuffer : public std::stringbuf {
 public:
  WatchingBuffer(std::string text, std::atomic<bool>* flag) : text_(std::move(text)), flag_(flag) {}

 protected:
  int sync() override {
    if (str().find(text_) != std::string::npos) *flag_ = true;
    return 0;
  }

 private:
  std::string text_;
  std::atomic<bool>* flag_;
};

TEST(OptimizeCommand, ACancelledOptimizationKeepsItsBestPoint) {
  const ScratchFolder folder;
  std::atomic<bool> cancel{false};
  WatchingBuffer buffer("trial 3:", &cancel);
  std::ostringstream out;
  std::ostream err(&buffer);
  EXPECT_EQ(run({"optimize", kModel, short_study(folder), "--json", "--output", folder.path("job")},
                {out, err, cancel}),
            kFailed);
  Json object = Json::parse(out.str());
  EXPECT_EQ(object["termination"], "cancelled");
  EXPECT_EQ(object["error"]["code"], "cancelled");
  EXPECT_EQ(Json::parse(read_text_file(folder.path("job/result.json"))), object);
  EXPECT_EQ(object["evaluations"], 3);
  EXPECT_LE(object["objective"].get<double>(), object["initial_objective"].get<double>());
  EXPECT_EQ(lines_of(read_text_file(folder.path("job/tuned.csv"))).size(), 502U);
}

}  // namespace
}  // namespace codesign::cli
