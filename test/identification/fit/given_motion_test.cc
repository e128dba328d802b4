// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "identification/fit/given_motion.h"

#include <gtest/gtest.h>

#include <cmath>

#include "identification/comparison/compared_motion.h"
#include "identification/identify.h"
#include "identification/simulated_recording.h"
#include "recordings/some_recording.h"

namespace codesign {
namespace {

constexpr double kOmega = 7.0;

/// A pendulum whose suspension is shaken along x.
const std::string kShaken =
    R"(<robot name="shaken" xmlns:codesign="https://mechanism-codesign.org">
  <codesign:parameter name="mass" value="1.5" lower="0.1" upper="10"/>
  <codesign:parameter name="viscous" value="0.2" lower="0" upper="10"/>
  <link name="ground"/>
  <link name="table"><inertial><mass value="4"/>
    <inertia ixx="0.1" iyy="0.1" izz="0.1" ixy="0" ixz="0" iyz="0"/></inertial></link>
  <link name="bob"><inertial><origin xyz="0 0 -0.4"/><mass value="1.5" codesign:value="${mass}"/>
    <inertia ixx="0.02" iyy="0.02" izz="0.02" ixy="0" ixz="0" iyz="0"/></inertial></link>
  <joint name="slide" type="prismatic"><parent link="ground"/><child link="table"/>
    <axis xyz="1 0 0"/><limit lower="-1" upper="1" effort="1000" velocity="10"/></joint>
  <joint name="hinge" type="continuous"><parent link="table"/><child link="bob"/>
    <axis xyz="0 1 0"/><dynamics damping="0.2" friction="0" codesign:damping="${viscous}"/></joint>
</robot>
)";

const std::string kShake = "motion: {slide: {position: \"${0.05*sin(7*t)}\"}}\n";
const std::string kServo =
    "controllers: {servo: {type: pid, input: hinge/position, setpoint: {type: sine, amplitude: "
    "0.5, frequency: 0.7}, output: hinge, gains: {p: 30, i: 0, d: 3}}}\n";
const std::map<std::string, double> kTruth = {{"mass", 2.5}, {"viscous", 0.35}, {"gust", 3.0}};

Problem given_problem(const std::string& blocks, const std::string& identify = "{}",
                      const std::string& more = "") {
  return load_problem(
      {"shaken.urdf", kShaken}, {},
      {"study.yaml", "duration: 3\nidentify: " + identify + "\nparameters: {mass: {}, viscous: {}" +
                         more + "}\n" + blocks});
}

void expect_truth(const IdentificationResult& result, double relative) {
  ASSERT_TRUE(result.status.ok()) << result.status.cause;
  for (const IdentifiedNumber& number : result.numbers) {
    const double truth = kTruth.at(number.name);
    EXPECT_NEAR(number.value, truth, relative * truth) << number.name;
  }
}

TEST(GivenMotion, CompletesRecordings) {
  const Problem problem = given_problem(kShake + kServo);
  StudyRecordings recordings;
  recordings.data = {record_run(problem, kTruth, {"hinge"}, 100.0)};
  recordings.holdout = {record_run(problem, kTruth, {"slide", "hinge"}, 100.0)};
  const std::optional<StudyRecordings> completed = with_given_motions(problem, recordings);
  ASSERT_TRUE(completed);
  const JointSamples* slide = completed->data[0].find("slide");
  ASSERT_TRUE(slide && slide->is_prescribed);
  for (const std::size_t k : {0U, 50U, 300U}) {
    const double time = completed->data[0].times[k];
    EXPECT_NEAR(slide->position[k], 0.05 * std::sin(kOmega * time), 1e-15);
    EXPECT_NEAR(slide->velocity[k], 0.05 * kOmega * std::cos(kOmega * time), 1e-14);
  }
  EXPECT_FALSE(completed->holdout[0].find("slide")->is_prescribed);
  recordings.data = recordings.holdout;
  EXPECT_FALSE(with_given_motions(problem, recordings));
}

// The acceleration of the suspension turns the pendulum; a model without it would not find mass
// and damping.
TEST(GivenMotion, IsThatOfTheModelInEfforts) {
  const Problem problem = given_problem(kShake + kServo);
  StudyRecordings recordings;
  recordings.data = {record_run(problem, kTruth, {"hinge"}, 500.0)};
  const IdentificationResult result = identify(problem, recordings, {}, nullptr);
  expect_truth(result, 2e-4);
  ASSERT_EQ(result.data.size(), 1U);
  EXPECT_GT(result.data[0].explained, 1.0 - 1e-6);
  const ComparedMotion shown = compare_motion(problem, recordings, result, 50.0);
  ASSERT_TRUE(shown.recordings[0].status.ok()) << shown.recordings[0].status.cause;
  EXPECT_GT(shown.recordings[0].model.size(), 100U);
}

TEST(GivenMotion, OfARecordedJointIsTheRecordedOne) {
  const Problem problem = given_problem(kShake + kServo);
  StudyRecordings recordings;
  recordings.data = {record_run(problem, kTruth, {"slide", "hinge"}, 500.0)};
  // The table's own clock is one second late, which the recorded positions show.
  const Problem late =
      given_problem("motion: {slide: {position: \"${0.05*sin(7*(t-1))}\"}}\n" + kServo);
  const IdentificationResult result = identify(late, recordings, {}, nullptr);
  expect_truth(result, 2e-4);
  EXPECT_EQ(result.data.size(), 2U);  // the efforts of both joints
}

TEST(GivenMotion, MovesSegments) {
  const Problem problem = given_problem(kShake + "initial_state: {hinge: {position: 0.6}}\n",
                                        "{residual: motion, segment: 1.5}");
  StudyRecordings recordings;
  recordings.data = {record_run(problem, kTruth, {"hinge"}, 100.0)};
  for (double& effort : recordings.data[0].joints[0].effort) effort = 0.0;
  const IdentificationResult result = identify(problem, recordings, {}, nullptr);
  expect_truth(result, 1e-3);
  ASSERT_EQ(result.data.size(), 1U);
  EXPECT_EQ(result.data[0].joint, "hinge/position");
}

// Nothing is free, so that segments have no start to seek, and the efforts of the motions tell the
// numbers.
TEST(GivenMotion, OfAllJointsLeavesEfforts) {
  const Problem problem = given_problem(
      "motion: {slide: {position: \"${0.05*sin(7*t)}\"}, hinge: {position: \"${0.5*sin(4*t)}\"}}\n",
      "{residual: motion, segment: 1.0}");
  StudyRecordings recordings;
  recordings.data = {record_run(problem, kTruth, {"slide", "hinge"}, 100.0)};
  const IdentificationResult result = identify(problem, recordings, {}, nullptr);
  expect_truth(result, 1e-6);
}

TEST(GivenMotion, LoadsHaveTheClockOfTheRecording) {
  const std::string gust =
      "loads: [{link: bob, force: [{type: sine, amplitude: \"${gust}\", frequency: 1.5}, 0, 0], "
      "point: "
      "[0, 0, -0.4]}]\n";
  for (const std::string residual : {"effort", "motion"}) {
    const Problem problem = given_problem(
        kShake + gust +
            (residual == "effort" ? kServo : "initial_state: {hinge: {position: 0.6}}\n"),
        "{residual: " + residual + "}", ", gust: {initial: 2.0, lower: 0, upper: 10}");
    StudyRecordings recordings;
    recordings.data = {record_run(problem, kTruth, {"hinge"}, 500.0)};
    JointRecording& recording = recordings.data[0];
    if (residual == "motion")
      for (double& effort : recording.joints[0].effort) effort = 0.0;
    const std::ptrdiff_t cut = 200;  // the recording begins at 0.4 s
    recording.times.erase(recording.times.begin(), recording.times.begin() + cut);
    recording.places.resize(recording.times.size());
    for (std::vector<double>* column : {&recording.joints[0].position, &recording.joints[0].effort})
      column->erase(column->begin(), column->begin() + cut);
    expect_truth(identify(problem, recordings, {}, nullptr), 1e-3);
  }
}

TEST(GivenMotion, RefusesTunedFunctionsThatAreNotRecorded) {
  const Problem problem = given_problem(
      "motion: {slide: {position: {type: sine, amplitude: \"${a}\", frequency: 1}}}\n" + kServo,
      "{}", ", a: {initial: 0.05, lower: 0, upper: 1}");
  StudyRecordings recordings;
  recordings.data = {record_run(problem, {}, {"hinge"}, 100.0)};
  const InputFault fault = refusal_of([&] { identify(problem, recordings, {}, nullptr); });
  EXPECT_EQ(fault.element, "motion.slide");
  EXPECT_EQ(fault.value, "a");
  expect_word(fault.message, "a motion that identify.data[0] does not have");
}

}  // namespace
}  // namespace codesign
