// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
// The four commands from end to end on a shipped case.
#include <gtest/gtest.h>

#include "cli/run_fixture.h"

namespace codesign::cli {
namespace {

const std::string kModel = shipped("urdf/slider_crank.urdf");
const std::string kStudy = shipped("config/slider_crank.yaml");
const std::vector<std::string> kTuned = {"crank_length", "rod_length", "slider_length", "slider_width", "Kp"};

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

void expect_keys(const Json& object, const std::vector<std::string>& keys) {
  for (const std::string& key : keys) EXPECT_TRUE(object.contains(key)) << key;
}

/// The shipped study cut short, so that a test of shapes takes a moment only.
std::string short_study(const ScratchFolder& folder) {
  const std::string path = folder.edited("short.yaml", read_text_file(kStudy), "duration: 2.0", "duration: 0.1");
  return folder.edited("short.yaml", read_text_file(path), "max_evaluations: 200", "max_evaluations: 4");
}

TEST(SliderCrank, CheckPrintsThePapersTable) {
  const Outcome outcome = run_words({"check", kModel, kStudy});
  ASSERT_EQ(outcome.code, kDone) << outcome.err;
  for (const char* row : {"bodies", "coordinates", "first-order equations", "degrees of freedom", "dynamic equations", "equations in all"})
    EXPECT_NE(outcome.out.find(row), std::string::npos) << row;
  Json counts = json_of(run_words({"check", kModel, kStudy, "--json"}))["counts"];
  const std::vector<std::pair<std::string, int>> expected = {
      {"bodies", 3},          {"coordinates", 21},          {"first_order_equations", 42}, {"degrees_of_freedom", 1},
      {"constraints", 20},    {"redundant_constraints", 0}, {"dynamic_equations", 62},     {"parameters", 5},
      {"sensitivities", 310}, {"total_equations", 372}};
  for (const auto& [key, value] : expected) EXPECT_EQ(counts[key], value) << key;
}

TEST(SliderCrank, CheckTakesAMechanismAlone) {
  Json object = json_of(run_words({"check", kModel, "--json", "--set", "crank_length=0.07"}));
  EXPECT_EQ(object["counts"]["parameters"], 0);
  EXPECT_EQ(object["counts"]["total_equations"], 62);
  EXPECT_EQ(object["parameters"]["crank_length"], 0.07);
  EXPECT_FALSE(object["parameters"].contains("Kp"));
}

TEST(SliderCrank, SimulateWritesTheSignalsAskedFor) {
  const Outcome outcome =
      run_words({"simulate", kModel, kStudy, "--signals", "crank_joint/velocity,slider_joint/position", "--samples", "3"});
  ASSERT_EQ(outcome.code, kDone) << outcome.err;
  const std::vector<std::string> lines = lines_of(outcome.out);
  ASSERT_EQ(lines.size(), 4U);
  EXPECT_EQ(lines[0], "time,crank_joint/velocity,slider_joint/position");
  EXPECT_EQ(lines[1].substr(0, 2), "0,");
  EXPECT_NEAR(std::stod(lines[1].substr(2)), -10.0, 1e-9);
  EXPECT_EQ(lines[2].substr(0, 2), "1,");
  EXPECT_EQ(lines[3].substr(0, 2), "2,");
}

TEST(SliderCrank, SimulateGivesSeriesAndObjectiveAsJson) {
  const ScratchFolder folder;
  const Outcome outcome = run_words({"simulate", kModel, kStudy, "--json", "--csv", folder.path("run.csv")});
  ASSERT_EQ(outcome.code, kDone) << outcome.err;
  Json object = json_of(outcome);
  expect_keys(object, {"objective", "parameters", "steps", "rejected_steps", "cpu_seconds", "counts", "series"});
  EXPECT_NEAR(object["objective"].get<double>() / 0.05925272691, 1.0, 1e-4);
  expect_keys(object["series"], {"time", "crank_joint/position", "slider_joint/velocity", "slider_joint/friction",
                                 "slider_joint/normal_force", "slider_joint/sliding_velocity", "crank_speed/output"});
  EXPECT_EQ(object["series"]["time"].size(), 101U);
  EXPECT_EQ(object["series"]["slider_joint/friction"].size(), 101U);
  EXPECT_EQ(lines_of(read_text_file(folder.path("run.csv"))).size(), 102U);
}

TEST(SliderCrank, GradientIsGivenByName) {
  const ScratchFolder folder;
  const Outcome outcome = run_words({"gradient", kModel, short_study(folder), "--json"});
  ASSERT_EQ(outcome.code, kDone) << outcome.err;
  Json object = json_of(outcome);
  expect_keys(object, {"objective", "gradient", "parameters", "steps", "rejected_steps", "cpu_seconds", "counts"});
  EXPECT_EQ(object["gradient"].size(), kTuned.size());
  expect_keys(object["gradient"], kTuned);
  EXPECT_FALSE(object.contains("verification"));
}

void expect_gradient(const std::string& name, double objective, const std::vector<double>& gradient) {
  Json object = json_of(run_words({"gradient", shipped("urdf/" + name + ".urdf"), shipped("config/" + name + ".yaml"), "--json"}));
  EXPECT_NEAR(object["objective"].get<double>() / objective, 1.0, 1e-7) << name;
  for (std::size_t k = 0; k < kTuned.size(); ++k)
    EXPECT_NEAR(object["gradient"][kTuned[k]].get<double>() / gradient[k], 1.0, 1e-5) << name << " " << kTuned[k];
}

// From an independent solution at tolerances down to 1e-12, whose gradients agree by complex step and Richardson differences.
TEST(SliderCrank, ShippedStudiesGiveThePublishedDigits) {
  expect_gradient("slider_crank", 0.05925272691, {1.674310, 0.0386376, 0.895474, 3.578859, -0.1185753});
  expect_gradient("slider_crank_haug", 0.717975196477, {32.0105032, -15.462857, -0.0754624, -0.3394216, -1.0274846});
}

TEST(SliderCrank, VerifySetsAReferenceBesideTheGradient) {
  const ScratchFolder folder;
  for (const std::string method : {"complex_step", "ridders"}) {
    const Outcome outcome = run_words({"gradient", kModel, short_study(folder), "--verify=" + method, "--json"});
    ASSERT_EQ(outcome.code, kDone) << outcome.err;
    Json verification = json_of(outcome)["verification"];
    EXPECT_EQ(verification["method"], method);
    expect_keys(verification["reference"], kTuned);
    expect_keys(verification["reference_error"], kTuned);
    EXPECT_LT(verification["largest_relative_difference"].get<double>(), method == "ridders" ? 1e-4 : 1e-8);
  }
  const std::string table = run_words({"gradient", kModel, short_study(folder), "--verify"}).out;
  EXPECT_NE(table.find("complex_step"), std::string::npos);
  EXPECT_NE(table.find("largest relative difference"), std::string::npos);
}

TEST(SliderCrank, OptimizeWritesItsFolder) {
  const ScratchFolder folder;
  const Outcome outcome = run_words({"optimize", kModel, short_study(folder), "--json", "--output", folder.path("job")});
  ASSERT_EQ(outcome.code, kDone) << outcome.err;
  Json object = json_of(outcome);
  expect_keys(object, {"objective", "initial_objective", "gradient", "parameters", "initial_parameters", "iterations", "evaluations",
                       "termination", "steps", "rejected_steps", "cpu_seconds", "counts"});
  EXPECT_LT(object["objective"].get<double>(), object["initial_objective"].get<double>());
  EXPECT_EQ(Json::parse(read_text_file(folder.path("job/result.json"))), object);
  const std::vector<std::string> convergence = lines_of(read_text_file(folder.path("job/convergence.csv")));
  EXPECT_EQ(convergence.at(0),
            "evaluation,iteration,status,objective,best_objective,gradient_norm,crank_length,rod_length,slider_length,slider_width,Kp");
  EXPECT_EQ(convergence.size(), 1U + object["evaluations"].get<std::size_t>());
  for (const char* name : {"job/initial.csv", "job/tuned.csv"}) EXPECT_EQ(lines_of(read_text_file(folder.path(name))).size(), 102U) << name;
  Json tuned = json_of(run_words({"check", folder.path("job/tuned.urdf"), "--json"}));
  EXPECT_NEAR(tuned["parameters"]["crank_length"].get<double>(), object["parameters"]["crank_length"].get<double>(), 1e-15);
}

TEST(SliderCrank, OptimizePrintsStartAndTunedDesign) {
  const ScratchFolder folder;
  const Outcome outcome = run_words({"optimize", kModel, short_study(folder)});
  ASSERT_EQ(outcome.code, kDone) << outcome.err;
  for (const std::string& name : kTuned) EXPECT_NE(outcome.out.find("\n" + name + " "), std::string::npos) << name;
  EXPECT_NE(outcome.out.find("max_evaluations_reached"), std::string::npos) << outcome.out;
  EXPECT_EQ(lines_of(outcome.err).size(), 4U) << outcome.err;
  EXPECT_EQ(outcome.err.substr(0, 8), "trial 1:");
}

/// Raises a flag once a text has been written to it, as a user would who reads along.
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

TEST(SliderCrank, ACancelledOptimizationKeepsItsBestPoint) {
  const ScratchFolder folder;
  std::atomic<bool> cancel{false};
  WatchingBuffer buffer("trial 3:", &cancel);
  std::ostringstream out;
  std::ostream err(&buffer);
  EXPECT_EQ(run({"optimize", kModel, short_study(folder), "--json", "--output", folder.path("job")}, {out, err, cancel}), kFailed);
  Json object = Json::parse(out.str());
  EXPECT_EQ(object["termination"], "cancelled");
  EXPECT_EQ(object["error"]["code"], "cancelled");
  EXPECT_EQ(object["evaluations"], 3);
  EXPECT_LE(object["objective"].get<double>(), object["initial_objective"].get<double>());
  EXPECT_EQ(lines_of(read_text_file(folder.path("job/tuned.csv"))).size(), 102U);
}

TEST(SliderCrank, ARunThatFailsNamesStatusTimeAndCause) {
  const ScratchFolder folder;
  const std::string study = folder.edited("study.yaml", read_text_file(kStudy), "solver: {", "solver: {maximum_steps: 20, ");
  const Outcome outcome = run_words({"simulate", kModel, study, "--json", "--samples", "2001"});
  EXPECT_EQ(outcome.code, kFailed);
  Json object = json_of(outcome);
  EXPECT_EQ(object["error"]["code"], "too_many_steps");
  EXPECT_GT(object["error"]["time"].get<double>(), 0.0);
  EXPECT_GT(object["series"]["time"].size(), 1U);
  EXPECT_NE(outcome.err.find("too_many_steps at t = "), std::string::npos) << outcome.err;
  EXPECT_EQ(run_words({"gradient", kModel, study}).code, kFailed);
  EXPECT_EQ(run_words({"optimize", kModel, study}).code, kFailed);
}

TEST(SliderCrank, ALoopThatCannotBeClosedIsBadInput) {
  const ScratchFolder folder;
  const std::string lower = "name=\"rod_length\" value=\"0.3\" lower=";
  const std::string text = read_text_file(shipped("urdf/slider_crank_haug.urdf"));
  const std::string model = folder.edited("model.urdf", text, lower + "\"0.2\"", lower + "\"0.01\"");
  const Outcome outcome = run_words({"simulate", model, shipped("config/slider_crank_haug.yaml"), "--json", "--set", "rod_length=0.05"});
  EXPECT_EQ(outcome.code, kBadInput);
  Json error = json_of(outcome)["error"];
  EXPECT_EQ(error["file"], model);
  EXPECT_NE(error["element"].get<std::string>().find("slider_pin"), std::string::npos);
}

}  // namespace
}  // namespace codesign::cli
