// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cmath>

#include "cli/run_fixture.h"
#include "excitation/excited_cases.h"
#include "jobs/json.h"
#include "text/number_text.h"

namespace codesign::cli {
namespace {

/// A model and a study of a pendulum in a folder of their own.
struct ExciteFiles {
  explicit ExciteFiles(const std::string& more = "", const std::string& axis = "0 1 0") {
    write("model.urdf", pendulum_urdf(axis));
    write("study.yaml",
          "identify: {data: [{csv: out/trajectory.csv}], intervals: {noise: white}}\n"
          "excite: {joints: {hinge: {noise: 0.1}}, period: 4.0, starts: 1, max_evaluations: 30, "
          "harmonics: 3" +
              more + "}\nparameters: {mass: {}, inertia: {}, viscous: {}}\n");
  }
  void write(const std::string& name, const std::string& text) const {
    std::ofstream(folder.path(name)) << text;
  }
  std::vector<std::string> words(const std::string& command) const {
    return {command,    folder.path("model.urdf"), folder.path("study.yaml"), "--json",
            "--output", folder.path("out")};
  }
  ScratchFolder folder;
};

TEST(ExciteCommand, WritesATrajectoryThatIdentifyReads) {
  const ExciteFiles files;
  const Outcome outcome = run_words(files.words("excite"));
  ASSERT_EQ(outcome.code, kDone) << outcome.err;
  Json object = json_of(outcome);
  EXPECT_GT(object["volume_factor"].get<double>(), 1.5);
  const Json file = Json::parse(read_text_file(files.folder.path("out/excitation.json")));
  EXPECT_EQ(file["volume_factor"], object["volume_factor"]);
  EXPECT_NE(read_text_file(files.folder.path("out/trajectory.csv"))
                .find("time,hinge/position,hinge/velocity,hinge/acceleration,hinge/effort"),
            std::string::npos);
  EXPECT_NE(read_text_file(files.folder.path("out/plain.csv")).find("time,hinge/position"),
            std::string::npos);
  EXPECT_FALSE(std::filesystem::exists(files.folder.path("out/trajectory.bag")))
      << "this test links no writer of bags";
  const Outcome identified = run_words(files.words("identify"));
  ASSERT_EQ(identified.code, kDone) << identified.err;
  EXPECT_NEAR(json_of(identified)["identified"]["mass"]["value"].get<double>(), 2.0, 1e-3);
}

TEST(ExciteCommand, PrintsWhatIsExpected) {
  const ExciteFiles files;
  const Outcome outcome =
      run_words({"excite", files.folder.path("model.urdf"), files.folder.path("study.yaml")});
  ASSERT_EQ(outcome.code, kDone) << outcome.err;
  EXPECT_NE(outcome.out.find("times smaller than with the plain trajectory"), std::string::npos)
      << outcome.out;
  EXPECT_NE(outcome.out.find("hinge/effort"), std::string::npos);
  EXPECT_NE(outcome.err.find("start 1, evaluation 1: criterion"), std::string::npos) << outcome.err;
}

/// A table of four seconds of a sine, with 30 samples from `gap` on left out and positions from
/// `turn` on a whole turn lower.
std::string sine_table(double amplitude, int gap = 200, int turn = 400) {
  std::string text = "time,hinge/position\n";
  for (int k = 0; k < 400; ++k)
    if (const double t = 0.01 * k; k < gap || k >= gap + 30)
      text += std::to_string(t) + "," +
              to_decimal(amplitude * std::sin(3.0 * t) - (k >= turn ? 6.283185307179586 : 0.0)) +
              "\n";
  return text;
}

struct Comparison : ExciteFiles {
  Outcome run(const std::string& table, bool is_json) const {
    if (!table.empty()) write("given.csv", table);
    std::vector<std::string> words = {"excite", folder.path("model.urdf"),
                                      folder.path("study.yaml"), "--compare",
                                      folder.path("given.csv")};
    if (is_json) words.emplace_back("--json");
    return run_words(words);
  }
};

TEST(ExciteCommand, SaysWhetherAGivenTrajectoryKeepsTheLimits) {
  const Comparison files;
  const Outcome kept = files.run(sine_table(0.5, 400), false);
  ASSERT_EQ(kept.code, kDone) << kept.err;
  EXPECT_NE(kept.out.find("the compared trajectory keeps all limits at its samples"),
            std::string::npos)
      << kept.out;
  const Outcome broken = files.run(sine_table(-1.5, 400), false);
  EXPECT_NE(broken.out.find("breaks limits, the worst: hinge/"), std::string::npos) << broken.out;
  const Json limits = json_of(files.run(sine_table(-1.5, 400), true))["compared"]["limits"];
  EXPECT_NEAR(limits["hinge/velocity"]["highest"].get<double>(), 4.5, 1e-2);
  EXPECT_EQ(limits["hinge/velocity"]["upper"], 4.0);
}

TEST(ExciteCommand, LooksAtAGivenTrajectoryAsAtRecordings) {
  const Comparison files;
  const Outcome missing = files.run("", true);
  EXPECT_EQ(missing.code, kBadInput);
  EXPECT_EQ(json_of(missing)["error"]["element"], "--compare");
  const Json plain = json_of(files.run(sine_table(0.5, 400), true));
  const Json turned = json_of(files.run(sine_table(0.5, 400, 250), true));
  ASSERT_EQ(plain["warnings"].size(), 1U) << plain["warnings"];
  EXPECT_EQ(plain["warnings"][0]["code"], "recording_not_filtered");
  ASSERT_EQ(turned["warnings"].size(), 2U) << turned["warnings"];
  EXPECT_EQ(turned["warnings"][0]["code"], "recording_unwrapped");
  EXPECT_NEAR(
      turned["compared"]["condition"].get<double>() / plain["compared"]["condition"].get<double>(),
      1.0, 1e-3);
  const Outcome gap = files.run(sine_table(0.5), true);
  EXPECT_EQ(gap.code, kBadInput);
  EXPECT_NE(json_of(gap)["error"]["message"].get<std::string>().find("gap"), std::string::npos);
}

TEST(ExciteCommand, NamesWhatNoTrajectoryTells) {
  const ExciteFiles files("", "0 0 1");
  const Outcome outcome = run_words(files.words("excite"));
  EXPECT_EQ(outcome.code, kFailed);
  Json object = json_of(outcome);
  EXPECT_EQ(object["error"]["code"], "not_identifiable");
  EXPECT_NE(object["undetermined"][0].get<std::string>().find("inertia"), std::string::npos);
  EXPECT_TRUE(std::filesystem::exists(files.folder.path("out/trajectory.csv")))
      << "the rest is excited all the same";
}

TEST(ExciteCommand, StudiesWithoutTheBlock) {
  const ExciteFiles files;
  files.write("study.yaml", "identify: {data: [{csv: a.csv}]}\nparameters: {mass: {}}\n");
  const Outcome outcome = run_words(files.words("excite"));
  EXPECT_EQ(outcome.code, kBadInput);
  EXPECT_EQ(json_of(outcome)["error"]["element"], "excite");
  files.write("study.yaml",
              "identify: {}\nexcite: {joints: {hinge: {noise: 1}}}\nparameters: {mass: {}}\n");
  const Outcome nothing = run_words(files.words("identify"));
  EXPECT_EQ(nothing.code, kBadInput);
  EXPECT_EQ(json_of(nothing)["error"]["element"], "identify.data") << nothing.out;
}

TEST(ExciteCommand, IsCancelledAtOnce) {
  const ExciteFiles files;
  const Outcome outcome = run_words(files.words("excite"), true);
  EXPECT_EQ(outcome.code, kFailed);
  EXPECT_EQ(json_of(outcome)["error"]["code"], "cancelled");
}

}  // namespace
}  // namespace codesign::cli
