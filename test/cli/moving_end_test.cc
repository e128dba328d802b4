// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
// Studies whose end depends on the design, theory (21g), by the commands.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

#include "cli/run_fixture.h"
#include "jobs/json.h"

namespace codesign::cli {
namespace {

constexpr const char* kCart = R"(<robot name="cart">
  <link name="ground"/>
  <link name="body"><inertial><mass value="1"/>
    <inertia ixx="0.01" ixy="0" ixz="0" iyy="0.01" iyz="0" izz="0.01"/></inertial></link>
  <joint name="slide" type="prismatic"><parent link="ground"/><child link="body"/>
    <axis xyz="1 0 0"/><limit lower="-1000" upper="1000" effort="50" velocity="1000"/></joint>
</robot>)";

constexpr const char* kMinimumTime = R"(duration: "${T}"
loads: [{joint: slide, effort: "${t < ts ? 1 : -1}"}]
parameters:
  ts: {initial: 0.8, lower: 0.1, upper: 4.0}
  T: {initial: 2.5, lower: 0.5, upper: 5.0}
objective: {maximum: [{signal: end_time}]}
final:
  - {signal: slide/position, between: [1.0, 1.0]}
  - {signal: slide/velocity, between: [0.0, 0.0]}
)";

constexpr const char* kBrake = R"(duration: 5.0
until: "${slide/velocity <= 0}"
initial_state: {slide: {velocity: 3.0}}
loads: [{joint: slide, effort: "${-F}"}]
parameters: {F: {initial: 4, lower: 1, upper: 9}}
objective: {terminal: [{signal: slide/position}], integral: [{signal: slide/velocity}]}
)";

struct Files {
  explicit Files(const std::string& study)
      : model(folder.path("cart.urdf")), text(folder.path("study.yaml")) {
    std::ofstream(model) << kCart;
    std::ofstream(text) << study;
  }
  ScratchFolder folder;
  std::string model, text;
};

// From rest to rest over 1 m with at most 1 N on 1 kg: pushed for 1 s, then braked for 1 s.
TEST(MovingEnd, ASearchFindsTheMinimumTime) {
  const Files files(kMinimumTime);
  const Outcome outcome = run_words(
      {"optimize", files.model, files.text, "--json", "--output", files.folder.path("job")});
  ASSERT_EQ(outcome.code, kDone) << outcome.err;
  Json result = json_of(outcome);
  EXPECT_NEAR(result["parameters"]["T"].get<double>(), 2.0, 1e-6);
  EXPECT_NEAR(result["parameters"]["ts"].get<double>(), 1.0, 1e-6);
  EXPECT_NEAR(result["objective"].get<double>(), 2.0, 1e-6);
  EXPECT_TRUE(result["warnings"].empty()) << result["warnings"];
}

TEST(MovingEnd, ASimulationHasItsSamplesUpToTheEnd) {
  for (const bool tuned : {true, false}) {
    const Files files(tuned ? kMinimumTime : kBrake);
    const double end = tuned ? 2.5 : 0.75;
    const Outcome outcome =
        run_words({"simulate", files.model, files.text, "--json", "--samples", "11"});
    ASSERT_EQ(outcome.code, kDone) << outcome.err;
    EXPECT_NE(outcome.err.find("simulated " + std::string(tuned ? "2.5 s" : "0.75 s")),
              std::string::npos)
        << outcome.err;
    Json result = json_of(outcome);
    EXPECT_NEAR(result["end_time"].get<double>(), end, 1e-12);
    const auto times = result["series"]["time"].get<std::vector<double>>();
    ASSERT_EQ(times.size(), 11U);
    for (std::size_t k = 0; k < times.size(); ++k)
      EXPECT_NEAR(times[k], end * static_cast<double>(k) / 10.0, 1e-12);
    const double at_end = result["series"]["slide/velocity"].get<std::vector<double>>().back();
    EXPECT_NEAR(at_end, tuned ? 0.8 - 1.7 : 0.0, 1e-9);
    EXPECT_TRUE(result.contains("objective"));
  }
}

TEST(MovingEnd, DifferencesThroughOtherStepsAgree) {
  for (const char* study : {kMinimumTime, kBrake}) {
    const Files files(study);
    const Outcome outcome = run_words({"gradient", files.model, files.text, "--verify", "--json"});
    ASSERT_EQ(outcome.code, kDone) << outcome.err;
    Json result = json_of(outcome);
    EXPECT_TRUE(result["warnings"].empty()) << result["warnings"];
    const Json& other = result["verification"]["differences"];
    EXPECT_NEAR(other["gradient"].get<double>(), other["derivative"].get<double>(), 1e-5) << other;
  }
}

TEST(MovingEnd, ARunThatBeginsAtItsEndIsRefused) {
  const Files files(std::string(kBrake).replace(std::string(kBrake).find("<= 0"), 4, "<= 3"));
  const Outcome outcome = run_words({"simulate", files.model, files.text});
  EXPECT_EQ(outcome.code, kFailed);
  EXPECT_NE(outcome.err.find("study.yaml:2"), std::string::npos) << outcome.err;
  EXPECT_NE(outcome.err.find("true at the start"), std::string::npos) << outcome.err;
}

TEST(MovingEnd, EffortsHaveNoRunThatEnds) {
  const Files files("duration: 2\nuntil: \"${t > 1}\"\nmotion: {slide: {position: \"${t}\"}}\n");
  const Outcome outcome = run_words({"efforts", files.model, files.text});
  EXPECT_EQ(outcome.code, kBadInput) << outcome.out;
  EXPECT_NE(outcome.err.find("without a run that would find its end"), std::string::npos)
      << outcome.err;
}

}  // namespace
}  // namespace codesign::cli
