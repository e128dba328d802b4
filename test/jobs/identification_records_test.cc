// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <cmath>

#include "identification/identify.h"
#include "identification/swinging_arm.h"
#include "jobs/identification_records.h"
#include "jobs/json.h"
#include "problem/load_problem.h"
#include "reading/urdf/urdf_reader.h"

namespace codesign {
namespace {

TEST(IdentificationFiles, TextsOfOneResult) {
  const Problem problem = swinging_problem();
  StudyRecordings recordings;
  recordings.data = {SwingingRig().record("identify.data[0]")};
  const IdentificationResult result = identify(problem, recordings, {}, nullptr);
  ASSERT_TRUE(result.status.ok());
  const std::string json = to_text(identification_json(problem, result));
  const std::vector<IdentificationFile> files = identification_files(problem, result, json);
  ASSERT_EQ(files.size(), 5U);
  EXPECT_EQ(files[0].name, "identification.json");
  EXPECT_EQ(files[0].text(), json);
  EXPECT_EQ(files[1].name, "identified_overlay.urdf");
  EXPECT_EQ(files[2].name, "identified.urdf");
  EXPECT_EQ(read_urdf({"identified", files[2].text()}).parameters[1].value,
            result.numbers[1].value);
  EXPECT_EQ(files[3].name, "residuals.csv");
  EXPECT_EQ(
      files[3].text().substr(0, 50).find("set,recording,time,hinge/recorded,hinge/computed\n"), 0U);
  EXPECT_EQ(files[4].name, "job_study.yaml");
  EXPECT_EQ(files[4].text(), swinging_study());

  const IdentificationShow show = identification_show(
      problem, result, json, compare_motion(problem, recordings, result, kShownRate));
  EXPECT_EQ(show.study, swinging_study());
  EXPECT_EQ(show.joints, std::vector<std::string>{"hinge"});
  EXPECT_EQ(show.urdf, files[2].text());
  EXPECT_EQ(show.data.times.size(), static_cast<std::size_t>(result.samples));
  EXPECT_EQ(show.motion.recordings.size(), 1U);
}

/// An arm in gravity with a free bar; an overlay adds the friction.
const SourceText kModel{"arm.urdf", R"(<robot name="arm" xmlns:codesign="urn:mechanism_codesign">
  <codesign:parameter name="length" value="0.5" lower="0.4" upper="0.6" unit="m"/>
  <link name="base"/>
  <link name="bar"><inertial codesign:inertia="free"><origin xyz="0 0 -0.4"/><mass value="2"/>
    <inertia ixx="0.1" iyy="0.1" izz="0.1" ixy="0" ixz="0" iyz="0"/></inertial></link>
  <link name="tip"><inertial><origin xyz="0 0 -0.5" codesign:xyz="0 0 ${-length}"/><mass value="0.3"/>
    <inertia ixx="0.01" iyy="0.01" izz="0.01" ixy="0" ixz="0" iyz="0"/></inertial></link>
  <joint name="hinge" type="continuous"><parent link="base"/><child link="bar"/><axis xyz="0 1 0"/></joint>
  <joint name="weld" type="fixed"><parent link="bar"/><child link="tip"/></joint>
</robot>)"};
const SourceText kBrakes{"brakes.urdf",
                         R"(<robot name="brakes" xmlns:codesign="urn:mechanism_codesign">
  <codesign:parameter name="viscous" value="0.1" lower="0" upper="0.3" unit="N m s/rad"/>
  <joint name="hinge"><dynamics damping="0.1" friction="0" codesign:damping="${viscous}"/></joint>
</robot>)"};

std::string study_with(const std::string& joints) {
  return "identify:\n  data: [{csv: data.csv}]\n  filter: {cutoff: 20.0}\n  joints: {hinge: " +
         joints +
         "}\nparameters: {bar_d3: {}, bar_t3: {}, viscous: {upper: 10.0}, length: {initial: 0.55, "
         "tune: false}}\n"
         "optimizer: {algorithm: levenberg_marquardt, relative_tolerance: 1.0e-8}\n";
}

JointRecording arm_recording() {
  JointRecording recording;
  recording.file = "data.csv";
  recording.element = "identify.data[0]";
  recording.where = {"study.yaml", 2};
  JointSamples hinge{"hinge", {}, {}, {}};
  for (int k = 0; k < 1000; ++k) {
    const double t = 0.01 * k, q = std::sin(2.0 * t) + 0.3 * std::sin(4.6 * t),
                 v = 2.0 * std::cos(2.0 * t) + 1.38 * std::cos(4.6 * t);
    const double a = -4.0 * std::sin(2.0 * t) - 6.348 * std::sin(4.6 * t);
    recording.times.push_back(t);
    recording.places.push_back(static_cast<std::size_t>(k) + 2);
    hinge.position.push_back(q);
    hinge.velocity.push_back(v);
    // No arm needs these efforts, so that residuals remain.
    hinge.effort.push_back(
        (0.9 * a + 0.42 * v + 9.0 * std::sin(q) - 0.15 + 0.05 * std::sin(31.0 * t) * std::cos(t)) /
        3.0);
  }
  recording.joints = {hinge};
  return recording;
}

struct FittedArm {
  Problem problem;
  IdentificationResult result;
};

FittedArm fit_arm(const std::vector<SourceText>& overlays, const std::string& joints) {
  FittedArm fit{load_problem(kModel, overlays, {"study.yaml", study_with(joints)}), {}};
  StudyRecordings recordings;
  recordings.data = {arm_recording()};
  fit.result = identify(fit.problem, recordings, {}, nullptr);
  EXPECT_TRUE(fit.result.status.ok()) << fit.result.status.cause;
  return fit;
}

TEST(IdentifiedOverlay, MakesTheIdentifiedModel) {
  const FittedArm found = fit_arm({kBrakes}, "{effort_scale: 3.0, offset: {}}");
  const SourceText overlay{"identified_overlay.urdf",
                           identified_overlay(found.problem, found.result)};
  const std::string whole = write_tuned_urdf(kModel, {kBrakes}, found.result.parameters);
  EXPECT_EQ(write_tuned_urdf(kModel, {kBrakes, overlay}, found.result.parameters), whole);
  const RobotDescription merged = read_urdf(kModel, {kBrakes, overlay}),
                         alone = read_urdf({"identified.urdf", whole});
  ASSERT_EQ(merged.parameters.size(), alone.parameters.size());
  for (std::size_t k = 0; k < merged.parameters.size(); ++k) {
    EXPECT_EQ(merged.parameters[k].value, found.result.parameters[k]) << merged.parameters[k].name;
    EXPECT_EQ(merged.parameters[k].value, alone.parameters[k].value);
    EXPECT_EQ(merged.parameters[k].upper, alone.parameters[k].upper);
  }
  EXPECT_EQ(merged.links[2].inertial->origin.xyz[2].nominal(), -0.55) << "what the study gave, too";
}

/// The files alone, model, overlays and the numbers of sensors from the JSON, begin where the fit
/// ended.
TEST(IdentifiedOverlay, ReproducesTheResidualsOfTheFit) {
  const FittedArm found =
      fit_arm({kBrakes}, "{effort_scale: 3.0, offset: {}, delay: {initial: 0.0, upper: 0.02}}");
  const double rms = found.result.data[0].rms;
  EXPECT_GT(rms, 1e-3);
  EXPECT_LT(rms, 0.5 * found.result.data[0].start);
  const SourceText overlay{"identified_overlay.urdf",
                           identified_overlay(found.problem, found.result)};
  const Json json = Json::parse(identification_json(found.problem, found.result).dump());
  const std::string offset = json["identified"]["hinge/offset"]["value"].dump(),
                    delay = json["identified"]["hinge/delay"]["value"].dump();
  const FittedArm again =
      fit_arm({kBrakes, overlay}, "{effort_scale: 3.0, offset: {initial: " + offset +
                                      "}, delay: {initial: " + delay + ", upper: 0.02}}");
  EXPECT_NEAR(again.result.data[0].start, rms, 1e-12 * rms);
  EXPECT_NE(overlay.text.find("hinge: {offset: " + offset + "}"), std::string::npos)
      << overlay.text;
}

TEST(IdentifiedOverlay, TellsHowWellTheNumbersAreKnown) {
  FittedArm found = fit_arm({kBrakes}, "{effort_scale: 3.0, offset: {}}");
  IdentifiedNumber& first = found.result.numbers[0];
  ASSERT_EQ(first.name, "bar_d3");
  first.low = -1.25;
  first.high = 0.75;
  found.result.numbers[1].is_determined = false;
  found.result.numbers[2].is_on_bound = true;
  const std::string text = identified_overlay(found.problem, found.result);
  for (const char* part : {"-1.25 to 0.75", "not identifiable", "on its bound", "intervals of 95 %",
                           "[N m s/rad]", "not identified: as the study has it", "upper="})
    EXPECT_NE(text.find(part), std::string::npos) << "no '" << part << "' in\n" << text;
}

}  // namespace

}  // namespace codesign
