// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "identification/identify.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <random>

#include "description/study.h"
#include "identification/motion_rig.h"
#include "problem/load_problem.h"

namespace codesign {
namespace {

/// An arm that turns about a vertical axis: gravity does not act on it. Its centre is 0.5 m from
/// the axis.
constexpr const char* kArm = R"(<robot name="arm" xmlns:codesign="https://mechanism-codesign.org">
  <codesign:parameter name="mass" value="2" lower="0.1" upper="10"/>
  <codesign:parameter name="inertia" value="0.1" lower="0.001" upper="5"/>
  <codesign:parameter name="viscous" value="0.1" lower="0" upper="10"/>
  <link name="base"/>
  <link name="bar"><inertial><origin xyz="0.5 0 0"/><mass value="2" codesign:value="${mass}"/>
    <inertia ixx="0.1" iyy="0.1" izz="0.1" ixy="0" ixz="0" iyz="0" codesign:ixx="${inertia}" codesign:iyy="${inertia}" codesign:izz="${inertia}"/>
  </inertial></link>
  <joint name="hinge" type="continuous"><parent link="base"/><child link="bar"/><axis xyz="0 0 1"/>
    <dynamics damping="0.1" friction="0" codesign:damping="${viscous}"/></joint>
</robot>)";

std::string study_of(const std::string& parameters, const std::string& more = "") {
  return "identify:\n  data: [{csv: data.csv}]\n  filter: {cutoff: 20.0}\n" + more +
         "parameters: {" + parameters +
         "}\noptimizer: {algorithm: levenberg_marquardt, relative_tolerance: 1.0e-10}\n";
}

Problem problem_of(const std::string& parameters, const std::string& more = "") {
  return load_problem({"arm.urdf", kArm}, {}, {"study.yaml", study_of(parameters, more)});
}

/// A recording of the arm on a rig: `total` is its inertia about the axis [kg m^2], `damping` the
/// damping of the joint [N m s].
struct Rig {
  double total = 0.8, damping = 0.4, scale = 1.0, offset = 0.0, noise = 0.0;
  double speed = 2.0;

  JointRecording record(const std::string& element) const {
    std::mt19937 random(3);
    std::normal_distribution<double> normal;
    JointRecording recording;
    recording.file = "data.csv";
    recording.element = element;
    recording.where = {"study.yaml", 2};
    JointSamples hinge{"hinge", {}, {}, {}};
    for (int k = 0; k < 2000; ++k) {
      const double t = 0.005 * k, w = speed;
      recording.times.push_back(t);
      recording.places.push_back(static_cast<std::size_t>(k) + 2);
      hinge.position.push_back(std::sin(w * t) + 0.3 * std::sin(2.3 * w * t));
      hinge.velocity.push_back(w * std::cos(w * t) + 0.69 * w * std::cos(2.3 * w * t));
      const double acceleration =
          -w * w * (std::sin(w * t) + 0.3 * 2.3 * 2.3 * std::sin(2.3 * w * t));
      const double effort = total * acceleration + damping * hinge.velocity.back() + offset;
      hinge.effort.push_back(effort / scale + noise * normal(random));
    }
    recording.joints = {hinge};
    return recording;
  }
};

/// The study of an arm whose damping and inertia are tied by a constraint.
Problem constrained(const std::string& constraint) {
  return problem_of("inertia: {}, viscous: {}", "constraints: [\"" + constraint + "\"]\n");
}

IdentificationResult run(const Problem& problem, const Rig& rig, const Rig* holdout = nullptr) {
  StudyRecordings recordings;
  recordings.data = {rig.record("identify.data[0]")};
  if (holdout) recordings.holdout = {holdout->record("identify.holdout[0]")};
  return identify(problem, recordings, {}, nullptr);
}

TEST(Identify, FindsWhatARigWithoutNoiseHas) {
  const IdentificationResult result = run(problem_of("inertia: {}, viscous: {}"), Rig());
  ASSERT_TRUE(result.status.ok()) << result.status.cause;
  ASSERT_EQ(result.numbers.size(), 2U);
  EXPECT_NEAR(result.numbers[0].value, 0.8 - 2.0 * 0.25, 1e-6);
  EXPECT_NEAR(result.numbers[1].value, 0.4, 1e-6);
  EXPECT_LT(result.data[0].rms, 1e-5 * result.data[0].recorded);
  EXPECT_GT(result.data[0].start, 0.01 * result.data[0].recorded);
  EXPECT_EQ(result.parameters.size(), 3U);
}

TEST(Identify, AConstraintThatTheFitDoesNotKeepIsTold) {
  EXPECT_TRUE(run(constrained("viscous >= inertia"), Rig()).warnings.empty());
  const IdentificationResult result = run(constrained("inertia >= viscous"), Rig());
  ASSERT_EQ(result.warnings.size(), 1U);
  EXPECT_EQ(result.warnings[0].code, "identified_outside_constraint");
  EXPECT_NE(result.warnings[0].message.find("inertia >= viscous"), std::string::npos)
      << result.warnings[0].message;
}

TEST(Identify, ScaleAndOffsetOfTheSensor) {
  Rig rig;
  rig.total = 0.6;  // as in the model
  rig.scale = 11.0;
  rig.offset = 0.2;
  const IdentificationResult result = run(
      problem_of("viscous: {}", "  joints: {hinge: {effort_scale: {initial: 9.0}, offset: {}}}\n"),
      rig);
  ASSERT_TRUE(result.status.ok()) << result.status.cause;
  ASSERT_EQ(result.numbers.size(), 3U);
  EXPECT_EQ(result.numbers[1].name, "hinge/effort_scale");
  EXPECT_NEAR(result.numbers[1].value, 11.0, 1e-4);
  EXPECT_NEAR(result.numbers[2].value, 0.2, 1e-5);
}

TEST(Identify, MassAndInertiaOfAnArmWithoutGravityCannotBeToldApart) {
  const IdentificationResult result = run(problem_of("mass: {}, inertia: {}, viscous: {}"), Rig());
  EXPECT_EQ(result.status.code, StatusCode::kNotIdentifiable);
  ASSERT_EQ(result.undetermined.size(), 1U);
  EXPECT_NE(result.undetermined[0].find("mass"), std::string::npos) << result.undetermined[0];
  EXPECT_NE(result.undetermined[0].find("inertia"), std::string::npos);
  EXPECT_NE(result.status.cause.find(result.undetermined[0]), std::string::npos);
  EXPECT_EQ(result.rank, 2);
  EXPECT_FALSE(result.numbers[0].is_determined);
  EXPECT_TRUE(result.numbers[2].is_determined);
  EXPECT_NEAR(result.numbers[2].value, 0.4, 1e-6) << "what the data tell is found all the same";
  EXPECT_NEAR(0.25 * result.numbers[0].value + result.numbers[1].value, 0.8, 1e-6);
  EXPECT_TRUE(std::isinf(result.numbers[0].deviation));
}

TEST(Identify, IntervalsCoverTheTruth) {
  Rig rig;
  rig.noise = 0.05;
  const IdentificationResult result =
      run(problem_of("inertia: {}, viscous: {}", "  intervals: {profiles: true}\n"), rig);
  ASSERT_TRUE(result.status.ok());
  const double truth[] = {0.3, 0.4};
  for (std::size_t k = 0; k < 2; ++k) {
    const IdentifiedNumber& number = result.numbers[k];
    EXPECT_GT(number.deviation, 0.0);
    EXPECT_LT(std::abs(number.value - truth[k]), 4.0 * number.deviation);
    ASSERT_TRUE(number.profile);
    // The efforts are linear in both numbers, so that the profile agrees with the linear interval.
    EXPECT_NEAR(number.profile->lower, number.low, 0.02 * (number.high - number.low));
    EXPECT_NEAR(number.profile->upper, number.high, 0.02 * (number.high - number.low));
  }
  // The filter at 20 Hz leaves a fifth of the noise's power, which reaches up to 100 Hz.
  EXPECT_NEAR(result.data[0].rms, 0.05 * std::sqrt(0.2), 0.002);
}

TEST(Identify, AHoldoutThatIsNotExplainedComesFirst) {
  Rig rig, other;
  rig.noise = other.noise = 0.02;
  const Problem problem = problem_of("inertia: {}, viscous: {}");
  EXPECT_TRUE(run(problem, rig, &rig).warnings.empty());
  other.damping = 1.5;
  const IdentificationResult result = run(problem, rig, &other);
  ASSERT_FALSE(result.warnings.empty());
  EXPECT_EQ(result.warnings[0].code, "holdout_failed");
  ASSERT_EQ(result.holdout.size(), 1U);
  EXPECT_GT(result.holdout[0].rms, 5.0 * result.data[0].rms);
}

TEST(Identify, ANumberOnItsBoundIsReported) {
  const IdentificationResult result = run(problem_of("inertia: {}, viscous: {upper: 0.2}"), Rig());
  EXPECT_TRUE(result.numbers[1].is_on_bound);
  EXPECT_EQ(result.numbers[1].value, 0.2);
  ASSERT_EQ(result.warnings.size(), 1U);
  EXPECT_EQ(result.warnings[0].code, "identified_on_bound");
}

TEST(Identify, ABoundDoesNotMakeKnownWhatOthersMakeUpFor) {
  // Only 0.25 mass + inertia is known, 0.8: with the mass on its bound, any inertia near 0.55 fits
  // exactly.
  const IdentificationResult result =
      run(problem_of("mass: {upper: 2.0}, inertia: {}, viscous: {}"), Rig());
  EXPECT_EQ(result.status.code, StatusCode::kNotIdentifiable);
  for (std::size_t k : {0U, 1U}) EXPECT_FALSE(result.numbers[k].is_determined);
  EXPECT_TRUE(result.numbers[0].is_on_bound)
      << "a number on its bound is on it, whatever the data tell";
  EXPECT_FALSE(result.numbers[1].is_on_bound);
  EXPECT_TRUE(result.numbers[2].is_determined);
  EXPECT_EQ(result.rank, 2);
}

TEST(Identify, WhatIsKnownOfNumbersThatAreNotKnownEachIsReported) {
  Rig rig;
  rig.noise = 0.05;
  const IdentificationResult result = run(problem_of("mass: {}, inertia: {}, viscous: {}"), rig);
  ASSERT_EQ(result.combinations.size(), 1U) << "the damping is known alone";
  const BaseParameter& known = result.combinations[0];
  const bool by_mass = known.expression == "mass + 4 inertia";
  EXPECT_TRUE(by_mass || known.expression == "inertia + 0.25 mass") << known.expression;
  const double truth = by_mass ? 3.2 : 0.8;
  EXPECT_GT(known.deviation, 0.0);
  EXPECT_NEAR(known.value, truth, 4.0 * known.deviation);
  EXPECT_LT(known.deviation, 0.02 * truth);
  EXPECT_LT(known.low, known.value);
  EXPECT_GT(known.high, known.value);
}

TEST(Identify, APriorChoosesAmongWhatTheDataLeaveOpen) {
  const std::string parameters = "mass: {}, inertia: {}, viscous: {}";
  const IdentificationResult of_mass =
      run(problem_of(parameters, "  prior: {mass: 1.0e-4}\n"), Rig());
  EXPECT_NEAR(of_mass.numbers[0].value, 2.0, 1e-3);
  EXPECT_NEAR(of_mass.numbers[1].value, 0.3, 1e-3);
  const IdentificationResult of_inertia =
      run(problem_of(parameters, "  prior: {inertia: 1.0e-4}\n"), Rig());
  EXPECT_NEAR(of_inertia.numbers[1].value, 0.1, 1e-3);
  EXPECT_NEAR(of_inertia.numbers[0].value, 2.8, 1e-3);
  EXPECT_TRUE(of_inertia.status.ok()) << "the prior decides: " << of_inertia.status.cause;
  ASSERT_EQ(of_inertia.undetermined.size(), 1U) << "a prior is not what the data tell";
  EXPECT_FALSE(of_inertia.numbers[1].is_determined);
  const IdentificationResult of_friction =
      run(problem_of(parameters, "  prior: {viscous: 0.5}\n"), Rig());
  EXPECT_EQ(of_friction.status.code, StatusCode::kNotIdentifiable)
      << "this prior does not decide between mass and inertia";
  EXPECT_THROW(problem_of(parameters, "  prior: {masss: 0.3}\n"), InputError);
  EXPECT_THROW(problem_of(parameters, "  prior: {viscous: 0}\n"), InputError);
}

TEST(Identify, ADriveGainComesFromMotionsWithAndWithoutAPayload) {
  // A payload of the other motion is the only known inertia: efforts without it determine inertia
  // and damping per drive gain.
  const Problem problem = problem_of("mass: {tune: false}, inertia: {}, viscous: {}",
                                     "  holdout: [{csv: data.csv, set: {mass: 3.0}}]\n  joints: "
                                     "{hinge: {effort_scale: {initial: 5.0}}}\n");
  Rig without, with;
  without.scale = with.scale = 11.0;
  with.total = without.total + 0.25;
  StudyRecordings recordings;
  recordings.data = {without.record("identify.data[0]"), with.record("identify.data[1]")};
  EXPECT_NE(identify(problem, recordings, {}, nullptr).data[0].rms, 0.0);
  recordings.data[1].settings = study_of(problem).identification->holdout.at(0).settings;
  ASSERT_EQ(recordings.data[1].settings.size(), 1U);
  const IdentificationResult result = identify(problem, recordings, {}, nullptr);
  ASSERT_TRUE(result.status.ok()) << result.status.cause;
  EXPECT_NEAR(result.numbers[0].value, 0.3, 1e-4);
  EXPECT_NEAR(result.numbers[2].value, 11.0, 1e-3);
  EXPECT_EQ(result.data_series.lengths.size(), 2U);
  EXPECT_LT(result.data[0].rms, 1e-4 * result.data[0].recorded);
  EXPECT_THROW(problem_of("inertia: {}", "  holdout: [{csv: data.csv, set: {inertia: 3.0}}]\n"),
               InputError)
      << "it is tuned";
}

TEST(Identify, ACancelledFitStillJudgesItsHoldout) {
  const Rig rig;
  StudyRecordings recordings;
  recordings.data = {rig.record("identify.data[0]")};
  recordings.holdout = {rig.record("identify.holdout[0]")};
  std::atomic<bool> cancel{false};
  const auto stop = [&cancel](const FitTrial&) {
    cancel = true;
    return false;
  };
  const IdentificationResult result =
      identify(problem_of("inertia: {}, viscous: {}"), recordings, stop, &cancel);
  EXPECT_EQ(result.status.code, StatusCode::kCancelled);
  ASSERT_EQ(result.holdout.size(), 1U);
  EXPECT_GT(result.holdout[0].rms, 0.0);
}

TEST(Identify, ACancelBeforeItLeavesNothingToJudge) {
  const std::atomic<bool> cancel{true};
  int evaluations = 0;
  const auto count = [&evaluations](const FitTrial&) { return ++evaluations > 0; };
  // As load_recordings() leaves them when it is cancelled.
  const IdentificationResult result =
      identify(problem_of("inertia: {}, viscous: {}"), {}, count, &cancel);
  EXPECT_EQ(result.status.code, StatusCode::kCancelled);
  EXPECT_EQ(result.termination, "cancelled");
  EXPECT_TRUE(result.numbers.empty());
  EXPECT_EQ(evaluations, 0);
}

TEST(Identify, AFitThatMeetsItsLimitIsUsableAndSaysSo) {
  std::string study = study_of("inertia: {}, viscous: {}");
  study.replace(study.find("relative_tolerance"), 0, "max_evaluations: 1, ");
  StudyRecordings recordings;
  recordings.data = {Rig().record("identify.data[0]")};
  const IdentificationResult result = identify(
      load_problem({"arm.urdf", kArm}, {}, {"study.yaml", study}), recordings, {}, nullptr);
  EXPECT_TRUE(result.status.ok()) << "its numbers are those of the best point";
  EXPECT_TRUE(std::any_of(
      result.warnings.begin(), result.warnings.end(),
      [](const Warning& warning) { return warning.code == "max_evaluations_reached"; }));
}

TEST(Identify, ASpeedAloneIsIntegratedFromAStartThatIsFitted) {
  // Gravity acts on this arm, so that the effort determines its position.
  std::string hanging = kArm;
  hanging.replace(hanging.find("<axis xyz=\"0 0 1\"/>"), 19, "<axis xyz=\"0 -1 0\"/>");
  const Problem problem = load_problem(
      {"arm.urdf", hanging}, {},
      {"study.yaml",
       "identify:\n  data: [{csv: data.csv, start: {hinge: {initial: 0.7, lower: -1, upper: 1}}}]\n"
       "  filter: {cutoff: 20.0}\nparameters: {inertia: {}, viscous: {}}\n"
       "optimizer: {algorithm: levenberg_marquardt, relative_tolerance: 1.0e-10}\n"});
  JointRecording recording = Rig().record("identify.data[0]");
  JointSamples& hinge = recording.joints[0];
  for (std::size_t k = 0; k < hinge.effort.size(); ++k)
    hinge.effort[k] += 2.0 * 9.81 * 0.5 * std::cos(hinge.position[k] - 0.35);
  hinge.position.clear();
  hinge.start = study_of(problem).identification->data[0].starts.at(0).position;
  StudyRecordings recordings;
  recordings.data = {recording};
  const IdentificationResult result = identify(problem, recordings, {}, nullptr);
  ASSERT_TRUE(result.status.ok()) << result.status.cause;
  ASSERT_EQ(result.numbers.size(), 3U);
  EXPECT_NEAR(result.numbers[0].value, 0.3, 1e-4);
  EXPECT_NEAR(result.numbers[1].value, 0.4, 1e-4);
  EXPECT_EQ(result.numbers[2].name, "data[0].start.hinge");
  EXPECT_EQ(result.numbers[2].unit, "rad");
  EXPECT_NEAR(result.numbers[2].value, -0.35, 1e-3)
      << "the recording begins at 0, which the sensor of the test calls -0.35";
  EXPECT_GT(result.numbers[2].deviation, 0.0);
  recordings.data[0].joints[0].start.reset();
  try {
    identify(problem, recordings, {}, nullptr);
    FAIL() << "accepted";
  } catch (const InputError& error) {
    EXPECT_EQ(error.fault().value, "hinge");
    EXPECT_NE(error.fault().allowed.find("start: {hinge: POSITION}"), std::string::npos)
        << error.fault().allowed;
  }
}

TEST(Identify, AStartThatNothingTellsIsNamed) {
  // Nothing depends on the angle about a vertical axis.
  const Problem problem = load_problem(
      {"arm.urdf", kArm}, {},
      {"study.yaml",
       "identify:\n  data: [{csv: data.csv, start: {hinge: {}}}]\n  filter: {cutoff: 20.0}\n"
       "parameters: {inertia: {}, viscous: {}}\noptimizer: {algorithm: levenberg_marquardt}\n"});
  StudyRecordings recordings;
  recordings.data = {Rig().record("identify.data[0]")};
  recordings.data[0].joints[0].position.clear();
  recordings.data[0].joints[0].start =
      study_of(problem).identification->data[0].starts.at(0).position;
  const IdentificationResult result = identify(problem, recordings, {}, nullptr);
  EXPECT_EQ(result.status.code, StatusCode::kNotIdentifiable);
  ASSERT_EQ(result.undetermined.size(), 1U);
  EXPECT_EQ(result.undetermined[0], "data[0].start.hinge has no effect");
  EXPECT_NEAR(result.numbers[0].value, 0.3, 1e-4);
}

TEST(Identify, AFitThatRunsAgainstImpossibleDesignsSaysSo) {
  // The rig's inertia is less than the inertia of the mass at its place, so that the model would
  // need a negative inertia.
  Rig rig;
  rig.total = 0.4;
  const IdentificationResult result = run(problem_of("inertia: {lower: -5}, viscous: {}"), rig);
  ASSERT_FALSE(result.warnings.empty());
  EXPECT_EQ(result.warnings[0].code, "fit_hindered");
  EXPECT_NE(result.warnings[0].message.find("inertia"), std::string::npos)
      << result.warnings[0].message;
}

TEST(Identify, RecordingsNeedTheSameJoints) {
  const Problem problem = problem_of("viscous: {}");
  StudyRecordings recordings;
  recordings.data = {Rig().record("identify.data[0]"), Rig().record("identify.data[1]")};
  recordings.data[1].joints[0].joint = "other";
  try {
    identify(problem, recordings, {}, nullptr);
    FAIL() << "accepted";
  } catch (const InputError& error) {
    EXPECT_EQ(error.fault().element, "identify.data[1]");
    EXPECT_EQ(error.fault().value, "hinge");
  }
}

}  // namespace
}  // namespace codesign
