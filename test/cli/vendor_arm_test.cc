// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
// A vendor's URDF as written by an exporter, annotated by an overlay, in all commands.
#include <gtest/gtest.h>

#include <cmath>

#include "cli/slider_crank.h"
#include "jobs/json.h"

namespace codesign::cli {
namespace {

const std::string kArm = shipped("test/cli/vendor/vx600.urdf");
const std::string kOverlay = shipped("test/cli/vendor/vx600_friction.urdf");
const std::string kArmStudy = shipped("test/cli/vendor/vx600.yaml");

Json json_run(std::vector<std::string> words) {
  for (const char* word : {"--overlay", kOverlay.c_str(), "--json"}) words.emplace_back(word);
  const Outcome outcome = run_words(words);
  EXPECT_EQ(outcome.code, kDone) << outcome.err;
  return json_of(outcome);
}

TEST(VendorArm, IsReadWithoutItsAnnotationsToo) {
  const Json counts = json_of(run_words({"check", kArm, "--json"}))["counts"];
  // Links fixed to each other are one body, the world's are the ground; fingers count, frames do
  // not; one row for the mimic.
  EXPECT_EQ(counts["bodies"], 8);
  EXPECT_EQ(counts["constraints"], 8 * 5 + 1 + 8);
  EXPECT_EQ(counts["degrees_of_freedom"], 7);
  EXPECT_EQ(counts["redundant_constraints"], 0);
}

TEST(VendorArm, Checks) {
  const Json object = json_run({"check", kArm, kArmStudy});
  EXPECT_EQ(object["counts"]["parameters"], 3);
  EXPECT_EQ(object["limits_exceeded"].size(), 0U);
}

TEST(VendorArm, SimulatesWithFrictionLimitsAndMimics) {
  const Json object = json_run(
      {"simulate", kArm, kArmStudy, "--signals",
       "left_finger_joint/position,right_finger_joint/position,shoulder_lift_joint/friction,"
       "shoulder_lift_joint/effort,lift/output,shoulder_lift_joint/velocity"});
  const Json& series = object["series"];
  for (std::size_t k = 0; k < series["time"].size(); ++k) {
    EXPECT_NEAR(series["left_finger_joint/position"][k].get<double>(),
                series["right_finger_joint/position"][k].get<double>(), 1e-9);
    EXPECT_LT(std::abs(series["shoulder_lift_joint/effort"][k].get<double>()), 150.0);
    EXPECT_LE(series["shoulder_lift_joint/friction"][k].get<double>() *
                  series["shoulder_lift_joint/velocity"][k].get<double>(),
              1e-12);
  }
  EXPECT_GT(series["lift/output"][0].get<double>(), 170.0)
      << "more is asked for than the motor gives";
  // The setpoint lies beyond the finger's upper limit of 0.04 m.
  EXPECT_GT(series["left_finger_joint/position"].back().get<double>(), 0.04);
  EXPECT_LT(series["left_finger_joint/position"].back().get<double>(), 0.042);
}

TEST(VendorArm, VelocitiesBeyondTheirLimitAreReported) {
  const ScratchFolder folder;
  const std::string study =
      folder.edited("fast.yaml", read_text_file(kArmStudy), "elbow_joint: {position: 1.4}",
                    "elbow_joint: {position: 1.4, velocity: 4.0}");
  const Outcome outcome =
      run_words({"simulate", kArm, study, "--overlay", kOverlay, "--samples", "5"});
  ASSERT_EQ(outcome.code, kDone) << outcome.err;
  EXPECT_NE(
      outcome.err.find(
          "joint 'elbow_joint' exceeds its velocity limit 3.15 from t = 0 s; the worst value is 4"),
      std::string::npos)
      << outcome.err;
  const Outcome check = run_words({"check", kArm, study, "--overlay", kOverlay});
  EXPECT_NE(check.out.find("joint 'elbow_joint' exceeds its velocity limit"), std::string::npos)
      << check.out;
}

TEST(VendorArm, ItsGradientIsThatOfTheStepsTaken) {
  const Json object = json_run({"gradient", kArm, kArmStudy, "--verify"});
  for (const char* name : {"upper_arm_length", "finger_multiplier", "Kp"}) {
    EXPECT_NE(object["gradient"][name].get<double>(), 0.0) << name;
  }
  EXPECT_LT(object["verification"]["largest_relative_difference"].get<double>(), 1e-8);
}

TEST(VendorArm, FaultsAreNamedWithTheirPlace) {
  const ScratchFolder folder;
  const std::string overlay = read_text_file(kOverlay);
  const auto fault = [&](const std::string& from, const std::string& to) {
    const Outcome outcome = run_words({"check", kArm, kArmStudy, "--overlay",
                                       folder.edited("overlay.urdf", overlay, from, to), "--json"});
    EXPECT_EQ(outcome.code, kBadInput);
    return json_of(outcome)["error"];
  };
  Json error = fault("joint name=\"elbow_joint\"", "joint name=\"elbow_jiont\"");
  EXPECT_EQ(error["line"], 10);
  EXPECT_NE(error["message"].get<std::string>().find("did you mean \"elbow_joint\"?"),
            std::string::npos);
  error = fault("codesign:multiplier=\"${finger_multiplier}\"",
                "codesign:multiplier=\"${2*finger_multiplier}\"");
  EXPECT_EQ(error["line"], 18);
  EXPECT_EQ(error["element"], "<joint name=\"right_finger_joint\"> <mimic>");
}

}  // namespace
}  // namespace codesign::cli
