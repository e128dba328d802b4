// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <fstream>

#include "cli/slider_crank.h"
#include "jobs/json.h"

namespace codesign::cli {
namespace {

TEST(GradientCommand, IsGivenByName) {
  const ScratchFolder folder;
  const Outcome outcome = run_words({"gradient", kModel, short_study(folder), "--json"});
  ASSERT_EQ(outcome.code, kDone) << outcome.err;
  Json object = json_of(outcome);
  expect_keys(object, {"objective", "gradient", "parameters", "steps", "rejected_steps",
                       "cpu_seconds", "counts"});
  EXPECT_EQ(object["gradient"].size(), kTuned.size());
  expect_keys(object["gradient"], kTuned);
  EXPECT_FALSE(object.contains("verification"));
}

void expect_gradient(const std::string& name, double objective,
                     const std::vector<double>& gradient) {
  Json object = json_of(run_words({"gradient", shipped("urdf/" + name + ".urdf"),
                                   shipped("config/" + name + ".yaml"), "--json"}));
  EXPECT_NEAR(object["objective"].get<double>() / objective, 1.0, 1e-7) << name;
  for (std::size_t k = 0; k < kTuned.size(); ++k)
    EXPECT_NEAR(object["gradient"][kTuned[k]].get<double>() / gradient[k], 1.0, 1e-5)
        << name << " " << kTuned[k];
}

// From an independent solution at tolerances down to 1e-12, whose gradients agree by complex step
// and Richardson differences.
TEST(GradientCommand, ShippedStudiesGiveThePublishedDigits) {
  expect_gradient("slider_crank", 0.05925272691,
                  {1.674310, 0.0386376, 0.895474, 3.578859, -0.1185753});
  expect_gradient("slider_crank_haug", 0.717975196477,
                  {32.0105032, -15.462857, -0.0754624, -0.3394216, -1.0274846});
}

TEST(GradientCommand, OfOneRunIsThatOfTheStudyWithItsChanges) {
  const ScratchFolder folder;
  const std::string plain = short_study(folder), runs = folder.path("runs.yaml");
  std::ifstream of_plain(plain);
  std::ofstream(runs)
      << of_plain.rdbuf()
      << "\nruns: {as_is: {}, pushed: {loads: [{joint: crank_joint, effort: 0.5}]}}\n";
  const auto gradient = [&](const std::vector<std::string>& more) {
    std::vector<std::string> words = {"gradient", kModel, runs, "--json"};
    words.insert(words.end(), more.begin(), more.end());
    return json_of(run_words(words))["gradient"];
  };
  EXPECT_EQ(gradient({"--run", "as_is"}),
            json_of(run_words({"gradient", kModel, plain, "--json"}))["gradient"]);
  EXPECT_NE(gradient({"--run", "pushed"}), gradient({"--run", "as_is"}));
  EXPECT_NE(gradient({}), gradient({"--run", "as_is"})) << "the mean over both";
}

TEST(GradientCommand, VerifySetsAReferenceBesideTheGradient) {
  const ScratchFolder folder;
  for (const std::string method : {"complex_step", "ridders"}) {
    const Outcome outcome =
        run_words({"gradient", kModel, short_study(folder), "--verify=" + method, "--json"});
    ASSERT_EQ(outcome.code, kDone) << outcome.err;
    Json verification = json_of(outcome)["verification"];
    EXPECT_EQ(verification["method"], method);
    expect_keys(verification["reference"], kTuned);
    expect_keys(verification["reference_error"], kTuned);
    EXPECT_LT(verification["largest_relative_difference"].get<double>(),
              method == "ridders" ? 1e-4 : 1e-8);
  }
  const std::string table =
      run_words({"gradient", kModel, short_study(folder), "--verify=complex_step"}).out;
  EXPECT_NE(table.find("complex_step"), std::string::npos);
  EXPECT_NE(table.find("largest relative difference"), std::string::npos);
}

TEST(GradientCommand, VerifyAloneComparesAlongADirectionAndSaysSo) {
  const ScratchFolder folder;
  const Outcome outcome =
      run_words({"gradient", kModel, short_study(folder), "--verify", "--json"});
  ASSERT_EQ(outcome.code, kDone) << outcome.err;
  const Json verification = json_of(outcome)["verification"];
  EXPECT_EQ(verification["directions"], 1);
  const Json& differences = verification["differences"];
  EXPECT_FALSE(differences["disagrees"].get<bool>());
  EXPECT_LE(differences["evaluations"].get<int>(), 12);
  EXPECT_NEAR(differences["derivative"].get<double>() / differences["gradient"].get<double>(), 1.0,
              1e-3);
  EXPECT_LT(verification["largest_relative_difference"].get<double>(), 1e-8);
  const std::string out = run_words({"gradient", kModel, short_study(folder), "--verify"}).out;
  EXPECT_NE(out.find("differences of the objective ("), std::string::npos) << out;
  EXPECT_NE(out.find("with an error of"), std::string::npos);
  EXPECT_NE(out.find("along a direction"), std::string::npos);
  // Steps that obey solver.sensitivity_tolerance need no others.
  EXPECT_EQ(verification.contains("largest_change"),
            out.find("largest change with") != std::string::npos);
}

}  // namespace
}  // namespace codesign::cli
