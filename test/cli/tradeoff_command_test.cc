// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>

#include "cli/run_fixture.h"

namespace codesign::cli {
namespace {

/// The study of doc/study/tradeoff.md.
struct RegulatorFiles {
  ScratchFolder folder;

  RegulatorFiles() {
    std::ofstream(folder.path("cart.urdf")) << R"(<robot name="cart"><link name="ground"/>
  <link name="cart"><inertial><mass value="1"/><inertia ixx="0.1" ixy="0" ixz="0" iyy="0.1" iyz="0" izz="0.1"/></inertial></link>
  <joint name="slide" type="prismatic"><parent link="ground"/><child link="cart"/><axis xyz="1 0 0"/>
  <limit lower="-5" upper="5" effort="100" velocity="10"/></joint></robot>)";
    const std::string page = read_text_file(shipped("doc/study/tradeoff.md"));
    const std::size_t first = page.find("```yaml") + 8, last = page.find("```", first);
    std::ofstream(folder.path("cart.yaml")) << page.substr(first, last - first);
  }
  Outcome run(std::vector<std::string> options = {}, const std::string& command = "tradeoff",
              bool cancelled = false) const {
    std::vector<std::string> words{command, folder.path("cart.urdf"), folder.path("cart.yaml")};
    words.insert(words.end(), options.begin(), options.end());
    return run_words(words, cancelled);
  }
};

TEST(TradeoffCommand, PrintsATableAndProgress) {
  const Outcome outcome = RegulatorFiles().run({"--points", "4"});
  ASSERT_EQ(outcome.code, kDone) << outcome.err;
  EXPECT_EQ(outcome.out.rfind("point", 0), 0u) << outcome.out;
  EXPECT_NE(outcome.out.find("on_curve"), std::string::npos);
  EXPECT_NE(outcome.out.find("\n4 points, "), std::string::npos) << outcome.out;
  EXPECT_NE(outcome.err.find("point 4 of 4: error "), std::string::npos) << outcome.err;
}

TEST(TradeoffCommand, HasAllPointsInJsonAndInATable) {
  const RegulatorFiles files;
  const std::string path = files.folder.path("points.csv");
  const Json object = json_of(files.run({"--points", "4", "--csv", path, "--json", "--quiet"}));
  ASSERT_EQ(object["points"].size(), 4u);
  EXPECT_EQ(object["objectives"], Json({"error", "effort"}));
  EXPECT_EQ(object["tuned"], Json({"k1", "k2"}));
  std::istringstream lines(read_text_file(path));
  std::string line;
  std::getline(lines, line);
  EXPECT_EQ(line,
            "kind,objective_error,objective_effort,k1,k2,status,termination,stationarity,"
            "evaluations");
  for (const Json& point : object["points"]) {
    std::getline(lines, line);
    const std::string start =
        point["kind"].get<std::string>() + "," + Json(point["objectives"]["error"]).dump();
    EXPECT_EQ(line.rfind(start.substr(0, start.find(',') + 8), 0), 0u) << line << start;
    const double k1 = point["parameters"]["k1"], k2 = point["parameters"]["k2"];
    EXPECT_NEAR(point["objectives"]["effort"].get<double>(), k1 * k1 / (2.0 * k2), 1e-4 * k1);
  }
  const double least = object["ideal"]["error"], most = object["nadir"]["error"];
  EXPECT_NEAR(object["points"][0]["objectives"]["error"].get<double>(), least,
              1.1e-4 * (most - least));
}

TEST(TradeoffCommand, ACancelledJobSaysSo) {
  const Outcome outcome = RegulatorFiles().run({"--json"}, "tradeoff", true);
  EXPECT_EQ(outcome.code, kFailed);
  EXPECT_EQ(json_of(outcome)["error"]["code"], "cancelled");
}

TEST(TradeoffCommand, OtherCommandsSayWhatTheStudyIsFor) {
  const Outcome outcome = RegulatorFiles().run({}, "optimize");
  EXPECT_EQ(outcome.code, kBadInput);
  EXPECT_NE(outcome.err.find("`codesign tradeoff` computes the curve"), std::string::npos)
      << outcome.err;
  EXPECT_EQ(RegulatorFiles().run({}, "simulate").code, kDone);
}

TEST(TradeoffCommand, RefusesNumbersOfPointsThatAreNone) {
  for (const std::string points : {"x", "0", "-3", "2.5", "99999999999"})
    EXPECT_EQ(RegulatorFiles().run({"--points", points}).code, kBadInput) << points;
  EXPECT_EQ(RegulatorFiles().run({"--points", "2"}).code, kBadInput);
}

}  // namespace
}  // namespace codesign::cli
