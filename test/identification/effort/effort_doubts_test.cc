// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "identification/effort/effort_doubts.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "description/study.h"
#include "identification/fit_doubts.h"
#include "identification/identify.h"
#include "identification/motion_rig.h"
#include "identification/simulated_recording.h"
#include "identification/swinging_arm.h"
#include "problem/load_problem.h"

namespace codesign {
namespace {

/// Two pendulums on one stand, of different mass and length, one joint each.
constexpr const char* kTwo = R"(<robot name="two" xmlns:codesign="https://mechanism-codesign.org">
  <codesign:parameter name="long_mass" value="4" lower="1" upper="10"/>
  <codesign:parameter name="short_mass" value="1" lower="0.2" upper="3"/>
  <link name="base"/>
  <link name="long"><inertial><origin xyz="0.5 0 0"/><mass value="4" codesign:value="${long_mass}"/>
    <inertia ixx="0.01" iyy="0.01" izz="0.01" ixy="0" ixz="0" iyz="0"/></inertial></link>
  <link name="short"><inertial><origin xyz="0.2 0 0"/><mass value="1" codesign:value="${short_mass}"/>
    <inertia ixx="0.01" iyy="0.01" izz="0.01" ixy="0" ixz="0" iyz="0"/></inertial></link>
  <joint name="a" type="continuous"><parent link="base"/><child link="long"/><axis xyz="0 -1 0"/></joint>
  <joint name="b" type="continuous"><parent link="base"/><child link="short"/><axis xyz="0 -1 0"/></joint>
</robot>)";

/// @param more lines of the block `identify`. @param upper bound of both masses
Problem two_pendulums(const std::string& more = "", const std::string& upper = "10") {
  return load_problem(
      {"two.urdf", kTwo}, {},
      {"study.yaml", "identify:\n  data: [{csv: data.csv}]\n  filter: {cutoff: 20.0}\n" + more +
                         "parameters: {long_mass: {upper: " + upper +
                         "}, short_mass: {upper: " + upper +
                         "}}\n"
                         "optimizer: {algorithm: levenberg_marquardt}\n"});
}

/// Both swing, with masses of 5 kg and 1.2 kg.
JointRecording both_swing() {
  JointRecording recording;
  recording.file = "data.csv";
  recording.element = "identify.data[0]";
  recording.where = {"study.yaml", 2};
  JointSamples a{"a", {}, {}, {}}, b{"b", {}, {}, {}};
  const auto add = [](JointSamples* joint, double t, double w, double amplitude, double mass,
                      double length) {
    const double position = amplitude * std::sin(w * t), acceleration = -w * w * position;
    joint->position.push_back(position);
    joint->velocity.push_back(amplitude * w * std::cos(w * t));
    joint->effort.push_back((mass * length * length + 0.01) * acceleration +
                            mass * 9.81 * length * std::cos(position));
  };
  for (int k = 0; k < 1000; ++k) {
    const double t = 0.005 * k;
    recording.times.push_back(t);
    recording.places.push_back(static_cast<std::size_t>(k) + 2);
    add(&a, t, 3.0, 0.8, 5.0, 0.5);
    add(&b, t, 4.1, 1.1, 1.2, 0.2);
  }
  recording.joints = {a, b};
  return recording;
}

IdentificationResult fit(const Problem& problem, const JointRecording& recording) {
  StudyRecordings recordings;
  recordings.data = {recording};
  return identify(problem, recordings, {}, nullptr);
}

/// Whether a warning has this code and these words.
bool warns(const IdentificationResult& result, const std::string& code, const std::string& words) {
  return std::any_of(result.warnings.begin(), result.warnings.end(), [&](const Warning& warning) {
    return warning.code == code && warning.message.find(words) != std::string::npos;
  });
}

/// The fit is a failure, and one of its warnings has these words; so has one of `codesign check`.
void expect_named(const Problem& problem, const JointRecording& recording,
                  const std::string& words) {
  const IdentificationResult result = fit(problem, recording);
  EXPECT_EQ(result.status.code, StatusCode::kNotIdentifiable) << words;
  EXPECT_TRUE(warns(result, "effort_not_explained", words)) << words << ": " << result.status.cause;
  const Warnings checked =
      warnings_of(*study_of(problem).identification, find_effort_doubts(problem, {recording}));
  ASSERT_FALSE(checked.empty()) << words;
  EXPECT_EQ(checked[0].code, "recording_effort");
  EXPECT_NE(checked[0].message.find(words), std::string::npos) << checked[0].message;
}

TEST(EffortDoubts, NothingIsSaidOfARightRecording) {
  const IdentificationResult result = fit(two_pendulums(), both_swing());
  EXPECT_TRUE(result.status.ok()) << result.status.cause;
  EXPECT_TRUE(result.warnings.empty());
  EXPECT_GT(result.data[0].explained, 0.999);
  EXPECT_NEAR(result.numbers[0].value, 5.0, 1e-3);
  EXPECT_TRUE(find_effort_doubts(two_pendulums(), {both_swing()}).empty());
}

TEST(EffortDoubts, TheOtherSignIsNamed) {
  JointRecording recording = both_swing();
  for (double& effort : recording.joints[0].effort) effort = -effort;
  expect_named(two_pendulums(), recording, "with the other sign");
}

TEST(EffortDoubts, AnotherUnitIsNamed) {
  JointRecording recording = both_swing();
  for (double& effort : recording.joints[1].effort) effort *= 1000.0;
  expect_named(two_pendulums(), recording, "divided by about 1");
}

TEST(EffortDoubts, AUnitThatTheNumbersFollowIsDoubtedToo) {
  for (const double factor : {1000.0, 8.85}) {
    JointRecording recording = both_swing();
    for (double& effort : recording.joints[1].effort) effort *= factor;
    const IdentificationResult result = fit(two_pendulums("", "1e5"), recording);
    EXPECT_TRUE(result.status.ok()) << result.status.cause;
    EXPECT_GT(result.data[1].explained, 0.95);
    ASSERT_EQ(result.warnings.size(), 1U);
    EXPECT_TRUE(warns(result, "recording_effort", "effort of b contradicts")) << factor;
    EXPECT_TRUE(warns(result, "recording_effort", "divided by about 1")) << factor;
  }
}

/// A wheel about a vertical axis with friction; all of its numbers are sought.
Problem wheel(double inertia, double coulomb, double viscous, double cutoff = 20.0) {
  const auto declared = [](const std::string& name, double value) {
    return "<codesign:parameter name=\"" + name + "\" value=\"" + std::to_string(value) +
           "\" lower=\"0\" upper=\"1e4\"/>";
  };
  const auto twin = [](const std::string& name, const std::string& parameter, double value) {
    return " " + name + "=\"" + std::to_string(value) + "\" codesign:" + name + "=\"${" +
           parameter + "}\"";
  };
  const std::string urdf =
      "<robot name=\"w\" xmlns:codesign=\"urn:t\">" + declared("J", inertia) +
      declared("c", coulomb) + declared("b", viscous) +
      R"(<link name="base"/><link name="wheel"><inertial><mass value="0.1"/><inertia ixy="0" ixz="0" iyz="0")" +
      twin("ixx", "J", inertia) + twin("iyy", "J", inertia) + twin("izz", "J", inertia) +
      R"(/></inertial></link><joint name="j" type="continuous"><parent link="base"/><child link="wheel"/>
      <axis xyz="0 0 1"/><codesign:friction transition_velocity="0.01")" +
      twin("coulomb", "c", coulomb) + twin("viscous", "b", viscous) + "/></joint></robot>";
  return load_problem(
      {"wheel.urdf", urdf}, {},
      {"study.yaml", "identify:\n  data: [{csv: data.csv}]\n  filter: {cutoff: " +
                         std::to_string(cutoff) + "}\nparameters: {J: {}, c: {}, b: {}}\n"});
}

/// J = 0.02, c = 2, b = 0.6, with noise, times `factor`.
JointRecording wheel_recording(double factor, double end = 20.0, double rate = 200.0) {
  JointRecording recording;
  recording.file = "data.csv";
  recording.element = "identify.data[0]";
  recording.where = {"study.yaml", 2};
  JointSamples j{"j", {}, {}, {}};
  std::mt19937 random(4);
  std::normal_distribution<double> normal;
  for (int k = 0; k < static_cast<int>(end * rate); ++k) {
    const double t = k / rate, velocity = 3.0 * std::cos(3.0 * t) + 1.5 * std::cos(7.0 * t),
                 acceleration = -9.0 * std::sin(3.0 * t) - 10.5 * std::sin(7.0 * t);
    recording.times.push_back(t);
    recording.places.push_back(static_cast<std::size_t>(k) + 2);
    j.position.push_back(std::sin(3.0 * t) + 1.5 / 7.0 * std::sin(7.0 * t));
    j.velocity.push_back(velocity);
    j.effort.push_back(factor * (0.02 * acceleration + 2.0 * std::tanh(400.0 * velocity) +
                                 0.6 * velocity + 0.05 * normal(random)));
  }
  recording.joints = {j};
  return recording;
}

TEST(EffortDoubts, AWrongStartOfATunedNumberIsNoUnit) {
  for (const double viscous : {6.0, 20.0}) {
    const Problem problem = wheel(0.02, 1.0, viscous);
    EXPECT_TRUE(find_effort_doubts(problem, {wheel_recording(1.0)}).empty()) << viscous;
    const IdentificationResult result = fit(problem, wheel_recording(1.0));
    EXPECT_TRUE(result.status.ok()) << result.status.cause;
    EXPECT_TRUE(result.warnings.empty()) << result.warnings.front().message;
    EXPECT_NEAR(result.numbers[2].value, 0.6, 0.02);
  }
  const std::vector<EffortDoubt> found =
      find_effort_doubts(wheel(0.02, 2.0, 0.6), {wheel_recording(100.0)});
  ASSERT_EQ(found.size(), 1U) << "all numbers right, and the recording in another unit";
  EXPECT_TRUE(found[0].is_unit);
  EXPECT_EQ(found[0].mistake.find("divided by about "), 0U) << found[0].mistake;
}

TEST(EffortDoubts, AFilterThatRemovesTheMotionIsNamed) {
  const JointRecording recording = wheel_recording(1.0, 240.0, 20.0);
  const IdentificationResult result = fit(wheel(0.02, 2.0, 0.6, 0.05), recording);
  EXPECT_TRUE(warns(result, "effort_not_explained",
                    "the fit does not explain j: the filter of the study, of 0.05 Hz, leaves "));
  EXPECT_FALSE(warns(result, "effort_not_explained", "sign, unit, order?"));
  const std::vector<EffortDoubt> wide = find_effort_doubts(wheel(0.02, 2.0, 0.6, 5.0), {recording});
  EXPECT_TRUE(wide.empty()) << "a filter above the motion";
  JointRecording turned = recording;
  for (double& effort : turned.joints[0].effort) effort = -effort;
  EXPECT_TRUE(warns(fit(wheel(0.02, 2.0, 0.6, 5.0), turned), "effort_not_explained",
                    "sign, unit, order? with the other sign"));
}

TEST(EffortDoubts, AFitThatWasHinderedIsNotBlamedOnTheRecording) {
  IdentificationResult result;
  OutputFit poor;
  poor.joint = "j";
  poor.explained = -0.2;
  result.data = {poor};
  result.evaluations = 10;
  const Problem problem = wheel(0.02, 2.0, 0.6);
  const auto message_of = [&](int failed) {
    result.failed_evaluations = failed;
    Status failure;
    return unexplained_outputs(*study_of(problem).identification, result, {}, &failure)
        .at(0)
        .message;
  };
  EXPECT_NE(message_of(8).find("most points of the fit could not be evaluated"), std::string::npos)
      << message_of(8);
  EXPECT_NE(message_of(2).find("sign, unit, order?"), std::string::npos) << message_of(2);
}

/// A signal in motion may be named like the output of a joint, whose recorded effort is doubted.
TEST(EffortDoubts, ASignalInMotionIsNoOutputOfAJoint) {
  IdentificationDescription options;
  options.residual = ResidualKind::kMotion;
  IdentificationResult result;
  OutputFit poor;
  poor.joint = "hinge/velocity";
  poor.explained = 0.2;
  const std::vector<EffortDoubt> doubts = {{"hinge", -1.0, "with the other sign", 0.9}};
  for (const bool is_signal : {false, true}) {
    poor.is_signal = is_signal;
    result.data = {poor};
    Status failure;
    const Warnings warnings = unexplained_outputs(options, result, doubts, &failure);
    ASSERT_FALSE(warnings.empty());
    EXPECT_EQ(warnings[0].message.find("the other sign") == std::string::npos, is_signal);
    EXPECT_EQ(failure.ok(), is_signal);
  }
}

TEST(EffortDoubts, OutliersThatALossLeavesOutDoNotCount) {
  JointRecording recording = both_swing();
  for (std::size_t k = 10; k < recording.times.size(); k += 200)
    recording.joints[0].effort[k] += k % 400 == 10 ? 400.0 : -400.0;
  const IdentificationResult robust = fit(two_pendulums("  loss: {type: huber}\n"), recording);
  EXPECT_TRUE(robust.warnings.empty());
  EXPECT_GT(robust.data[0].explained, 0.9);
  EXPECT_NEAR(robust.numbers[0].value, 5.0, 0.05);
  EXPECT_TRUE(warns(fit(two_pendulums(), recording), "effort_not_explained", " % of a:"));
}

TEST(EffortDoubts, ExchangedEffortsAreNamed) {
  JointRecording recording = both_swing();
  std::swap(recording.joints[0].effort, recording.joints[1].effort);
  expect_named(two_pendulums(), recording, "with the column of b");
}

TEST(EffortDoubts, JointsInReversedOrderAreNamed) {
  JointRecording recording = both_swing();
  std::swap(recording.joints[0].joint, recording.joints[1].joint);
  for (double& effort : recording.joints[0].effort) effort = -effort;
  const Problem problem = two_pendulums();
  EXPECT_EQ(fit(problem, recording).status.code, StatusCode::kNotIdentifiable);
}

/// One pendulum hangs on the other: the effort of one looks like that of the other.
constexpr const char* kHanging =
    R"(<robot name="hanging" xmlns:codesign="https://mechanism-codesign.org">
  <codesign:parameter name="upper_mass" value="1.6" lower="0.1" upper="10"/>
  <codesign:parameter name="lower_mass" value="1.1" lower="0.1" upper="10"/>
  <link name="ground"/>
  <link name="top"><inertial><origin xyz="0 0 -0.25"/><mass value="1.6" codesign:value="${upper_mass}"/>
    <inertia ixx="0.05" iyy="0.05" izz="0.01" ixy="0" ixz="0" iyz="0"/></inertial></link>
  <link name="tip"><inertial><origin xyz="0 0 -0.2"/><mass value="1.1" codesign:value="${lower_mass}"/>
    <inertia ixx="0.02" iyy="0.02" izz="0.005" ixy="0" ixz="0" iyz="0"/></inertial></link>
  <joint name="shoulder" type="continuous"><parent link="ground"/><child link="top"/><axis xyz="0 1 0"/></joint>
  <joint name="elbow" type="continuous"><parent link="top"/><child link="tip"/><origin xyz="0 0 -0.5"/><axis xyz="0 1 0"/></joint>
</robot>)";

TEST(EffortDoubts, WholeJointsAreNamedRatherThanAColumn) {
  const Problem problem = load_problem(
      {"hanging.urdf", kHanging}, {},
      {"study.yaml",
       "duration: 8.0\n"
       "controllers:\n"
       "  a: {type: pid, input: shoulder/position, output: shoulder, gains: {p: 40.0, d: 4.0},"
       " setpoint: {type: sine, amplitude: 0.9, frequency: 0.5}}\n"
       "  b: {type: pid, input: elbow/position, output: elbow, gains: {p: 20.0, d: 2.0},"
       " setpoint: {type: sine, amplitude: 1.1, frequency: 0.8}}\n"
       "identify:\n  data: [{csv: data.csv}]\n  filter: {cutoff: 20.0}\n"
       "parameters: {upper_mass: {}, lower_mass: {}}\n"});
  JointRecording recording = record_run(problem, {}, {"shoulder", "elbow"}, 100.0);
  EXPECT_TRUE(find_effort_doubts(problem, {recording}).empty());
  std::swap(recording.joints[0].joint, recording.joints[1].joint);
  expect_named(problem, recording, "with the joints in reversed order");
}

TEST(EffortDoubts, ADriveLineIsFittedWithoutNegativeFactors) {
  Eigen::VectorXd computed(400), velocity(400), acceleration(400);
  for (int k = 0; k < 400; ++k) {
    velocity[k] = std::cos(0.1 * k);
    acceleration[k] = -std::sin(0.1 * k);
    computed[k] = std::sin(0.037 * k);
  }
  const Eigen::VectorXd recorded = 2.0 * computed + 3.0 * velocity;
  const DriveLineFit right = fit_drive_line(computed, velocity, acceleration, recorded);
  EXPECT_GT(right.share, 0.9999);
  EXPECT_NEAR(right.scale, 2.0, 0.01);
  EXPECT_LT(fit_drive_line(computed, velocity, acceleration, -recorded).share, 0.1);
}

TEST(EffortDoubts, TheShareIsCountedAboutTheMean) {
  const Eigen::Vector4d recorded(1.0, -1.0, 1.0, -1.0);
  EXPECT_DOUBLE_EQ(explained_share(recorded, Eigen::Vector4d::Zero()), 1.0);
  EXPECT_DOUBLE_EQ(explained_share(recorded, recorded), 0.0);
  EXPECT_DOUBLE_EQ(explained_share(recorded.array() + 1.0, recorded), 0.0);
  EXPECT_NEAR(explained_share(Eigen::Vector4d::Constant(100.0), Eigen::Vector4d::Constant(1.0)),
              0.99, 1e-12);
}

TEST(EffortDoubts, InMotionTheMistakeOfTheRecordedEffortIsNamed) {
  MotionRig rig;
  rig.duration = 3.0;
  StudyRecordings recordings;
  recordings.data = {record_pendulum(rig)};
  for (double& effort : recordings.data[0].joints[0].effort) effort = -effort;
  const Problem problem =
      motion_problem("", "  segment: 3.0\n  filter: {cutoff: 20.0}\n", "inertia: {}");
  const IdentificationResult result = identify(problem, recordings, {}, nullptr);
  EXPECT_EQ(result.status.code, StatusCode::kNotIdentifiable) << result.status.cause;
  const auto found =
      std::find_if(result.warnings.begin(), result.warnings.end(),
                   [](const Warning& warning) { return warning.code == "motion_not_explained"; });
  ASSERT_NE(found, result.warnings.end());
  const std::string words =
      " % of hinge/position: sign, unit, order? the recorded effort of hinge: with the other sign";
  EXPECT_NE(found->message.find(words), std::string::npos) << found->message;
}

// The start of a segment alone explains most of a motion, whatever drives it.
TEST(EffortDoubts, InMotionTheShareIsThatWithinSegments) {
  StudyRecordings recordings;
  recordings.data = {record_pendulum({})};
  const Problem problem = motion_problem("", "  segment: 0.5\n  filter: {cutoff: 20.0}\n",
                                         "inertia: {}, viscous: {}, dry: {}");
  const IdentificationResult right = identify(problem, recordings, {}, nullptr);
  EXPECT_TRUE(right.status.ok() && right.warnings.empty()) << right.status.cause;
  EXPECT_GT(right.data[0].explained, 0.999);
  for (double& effort : recordings.data[0].joints[0].effort) effort = -effort;
  const IdentificationResult wrong = identify(problem, recordings, {}, nullptr);
  EXPECT_EQ(wrong.status.code, StatusCode::kNotIdentifiable);
  EXPECT_TRUE(warns(wrong, "motion_not_explained", "with the other sign"));
  EXPECT_GT(1.0 - std::pow(wrong.data[0].rms / wrong.data[0].recorded, 2.0), kExplainedHalf)
      << "of the whole recording";
}

TEST(EffortDoubts, WhatInverseDynamicsRefuseIsNoErrorInMotion) {
  std::string model = motion_pendulum();
  model.insert(model.find("<dynamics"),
               "<codesign:friction model=\"lugre\" mu_static=\"0.3\" mu_dynamic=\"0.2\" "
               "transition_velocity=\"0.02\" joint_length=\"0.1\" pin_radius=\"0.05\"/>");
  const Problem problem =
      load_problem({"pendulum.urdf", model}, {},
                   {"study.yaml",
                    "identify:\n  data: [{csv: data.csv}]\n  residual: motion\n  filter: {cutoff: "
                    "20.0}\nparameters: {inertia: {}}\n"});
  EXPECT_TRUE(find_effort_doubts(problem, {record_pendulum({})}).empty());
}

}  // namespace
}  // namespace codesign
