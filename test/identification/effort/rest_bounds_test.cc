// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
// Friction of a joint at rest lies between the efforts of a joint that just moves either way.
#include "identification/effort/rest_bounds.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "description/study.h"
#include "identification/effort/effort_residuals.h"
#include "identification/identify.h"
#include "problem/load_problem.h"
#include "recordings/joint_recording.h"

namespace codesign {
namespace {

TEST(RestBounds, AddsAJointThatJustMovesEitherWay) {
  MotionSamples measured;
  measured.position = Eigen::MatrixXd::Random(2, 3);
  measured.velocity = Eigen::MatrixXd::Random(2, 3);
  measured.acceleration = Eigen::MatrixXd::Random(2, 3);
  measured.begins = {0, 2};
  measured.times = {0.0, 0.1, 0.5};
  Eigen::MatrixXd speeds = Eigen::MatrixXd::Zero(2, 3);
  speeds(1, 0) = 0.2;
  speeds(0, 2) = 0.3;
  const RestBounds bounds(measured, speeds);
  const MotionSamples& samples = bounds.samples();
  ASSERT_EQ(samples.position.cols(), 7);
  EXPECT_EQ(samples.begins, (std::vector<int>{0, 4}));
  EXPECT_EQ(samples.times, (std::vector<double>{0.0, 0.0, 0.0, 0.1, 0.5, 0.5, 0.5}));
  EXPECT_EQ(samples.numbers, (std::vector<int>{0, 0, 0, 1, 2, 2, 2}));
  for (Eigen::Index k = 0; k < 3; ++k)
    EXPECT_EQ(samples.velocity.col(bounds.place(k)), measured.velocity.col(k));
  EXPECT_TRUE(bounds.rests(1, 0) && bounds.rests(0, 2));
  EXPECT_FALSE(bounds.rests(0, 0) || bounds.rests(1, 1));
  EXPECT_EQ(bounds.bound(0, 0, true), bounds.place(0));
  for (const bool is_forward : {false, true}) {
    const Eigen::Index place = bounds.bound(1, 0, is_forward);
    EXPECT_EQ(samples.velocity(1, place), is_forward ? 0.2 : -0.2);
    EXPECT_EQ(samples.velocity(0, place), measured.velocity(0, 0));
    EXPECT_EQ(samples.position.col(place), measured.position.col(0));
    EXPECT_EQ(samples.acceleration.col(place), measured.acceleration.col(0));
  }
}

/// Each of two joints at rest has bounds of its own, with the other one as it was measured.
TEST(RestBounds, JointsRestBesideEachOther) {
  MotionSamples measured;
  measured.position = measured.velocity = measured.acceleration = Eigen::MatrixXd::Random(2, 2);
  Eigen::MatrixXd speeds = Eigen::MatrixXd::Zero(2, 2);
  speeds.col(1) << 0.2, 0.3;
  const RestBounds bounds(measured, speeds);
  ASSERT_EQ(bounds.samples().velocity.cols(), 6);
  for (const Eigen::Index joint : {0, 1})
    for (const bool is_forward : {false, true}) {
      const Eigen::Vector2d velocity =
          bounds.samples().velocity.col(bounds.bound(joint, 1, is_forward));
      EXPECT_EQ(velocity[joint], (is_forward ? 1.0 : -1.0) * speeds(joint, 1));
      EXPECT_EQ(velocity[1 - joint], measured.velocity(1 - joint, 1));
    }
  EXPECT_EQ(bounds.samples().velocity.col(bounds.place(1)), measured.velocity.col(1));
}

TEST(RestBounds, WithoutARestTheMotionStays) {
  MotionSamples measured;
  measured.position = measured.velocity = measured.acceleration = Eigen::MatrixXd::Random(1, 4);
  const RestBounds bounds(measured, Eigen::MatrixXd::Zero(1, 4));
  EXPECT_EQ(bounds.samples().position, measured.position);
  EXPECT_EQ(bounds.bound(0, 3, true), 3);
}

TEST(NearerBound, CountsOutsideAlone) {
  Eigen::MatrixXd backward(5, 2), forward(5, 2);
  backward << -3.0, 1.0, -1.0, 2.0, 1.0, 3.0, 2.0, 4.0, 0.0, 9.0;
  forward << -1.0, 5.0, 1.0, 6.0, 3.0, 7.0, 2.0, 4.0, 0.0, 9.0;
  take_nearer_bound(forward, &backward);
  Eigen::MatrixXd expected(5, 2);
  expected << -1.0, 5.0, 0.0, 0.0, 1.0, 3.0, 2.0, 4.0, 0.0, 9.0;
  EXPECT_EQ(backward, expected);
}

/// An arm on a vertical axis with 0.5 kg m^2 beyond its inertia.
constexpr const char* kArm = R"(<robot name="arm" xmlns:codesign="urn:mechanism_codesign">
  <codesign:parameter name="inertia" value="0.1" lower="0.001" upper="5"/>
  <codesign:parameter name="viscous" value="0.1" lower="0" upper="10"/>
  <codesign:parameter name="coulomb" value="0.2" lower="0" upper="10"/>
  <link name="base"/>
  <link name="bar"><inertial><origin xyz="0.5 0 0"/><mass value="2"/>
    <inertia ixx="0.1" iyy="0.1" izz="0.1" ixy="0" ixz="0" iyz="0" codesign:ixx="${inertia}" codesign:iyy="${inertia}" codesign:izz="${inertia}"/></inertial></link>
  <joint name="hinge" type="continuous"><parent link="base"/><child link="bar"/><axis xyz="0 0 1"/>
    <codesign:friction coulomb="0.2" codesign:coulomb="${coulomb}" viscous="0.1" codesign:viscous="${viscous}" transition_velocity="0.001"/></joint>
</robot>)";

constexpr double kSpeed = 0.05, kInertia = 0.8, kViscous = 0.4, kCoulomb = 0.9;

Problem arm(const std::string& filter) {
  return load_problem({"arm.urdf", kArm}, {},
                      {"study.yaml",
                       "identify:\n  data: [{csv: data.csv, mask: {speed: 0.05, "
                       "rest: bounds}}]\n  filter: {" +
                           filter +
                           "}\nparameters: {inertia: {}, viscous: {}, coulomb: "
                           "{}}\noptimizer: {relative_tolerance: 1.0e-12}\n"});
}

/// Moves there and back for 1 s by a fourth power of a sine and rests for 0.6 s in turn, with an
/// effort at rest that swings by `swing`.
JointRecording recording(double swing, RestRule rule, double noise = 0.0) {
  constexpr double kPi = 3.14159265358979323846;
  JointRecording result;
  result.file = "data.csv";
  result.element = "identify.data[0]";
  result.where = {"study.yaml", 2};
  JointSamples hinge{"hinge", {}, {}, {}};
  std::mt19937 random(3);
  std::normal_distribution<double> normal;
  for (int k = 0; k <= 2000; ++k) {
    const double t = 0.005 * k, within = std::fmod(t, 1.6);
    const bool moves = within < 1.0;
    const double w = kPi, s = std::sin(w * within), c = std::cos(w * within);
    const double v = moves ? w * std::pow(s, 3) * c : 0.0,
                 a = moves ? w * w * (3.0 * s * s * c * c - std::pow(s, 4)) : 0.0;
    const double rest = swing * std::sin(2.0 * kPi * (within - 1.0) / 0.6);
    const double friction = std::abs(v) < kSpeed ? rest : kCoulomb * (v > 0.0 ? 1.0 : -1.0);
    result.times.push_back(t);
    result.places.push_back(static_cast<std::size_t>(k) + 2);
    hinge.position.push_back(moves ? 0.25 * std::pow(s, 4) : 0.0);
    hinge.velocity.push_back(v);
    hinge.effort.push_back(kInertia * a + kViscous * v + friction + noise * normal(random));
  }
  hinge.least_speed = kSpeed;
  hinge.has_bounds = rule == RestRule::kBounds;
  result.joints = {hinge};
  return result;
}

IdentificationResult fit(double swing, const std::string& filter, RestRule rule,
                         double noise = 0.0) {
  StudyRecordings recordings;
  recordings.data = {recording(swing, rule, noise)};
  return identify(arm(filter), recordings, {}, nullptr);
}

TEST(RestBounds, ResidualsAndSlopesAreThoseOfTheNearerBreakaway) {
  const Problem problem = arm("cutoff: 0");
  const FitVariables variables(study_of(problem), &robot_of(problem));
  const std::vector<JointRecording> recordings = {recording(1.5, RestRule::kBounds)};
  Warnings warnings;
  EffortResiduals residuals(*system_of(problem), variables, require_same_joints(recordings),
                            {measured_motion(recordings[0], {}, &warnings)}, {}, 1);
  const Eigen::Vector3d x(kInertia - 0.5, kViscous, kCoulomb);
  ASSERT_EQ(variables.names(), (std::vector<std::string>{"inertia", "viscous", "coulomb"}));
  ASSERT_TRUE(residuals.begin(x).ok());
  Eigen::MatrixXd values, slopes;
  ASSERT_TRUE(residuals.evaluate(x, &values, &slopes).ok());
  const Eigen::MatrixXd counted = residuals.counted();
  const double breakaway = kCoulomb + kViscous * kSpeed;
  int within = 0, outside = 0;
  const std::vector<double> times = residuals.times();
  for (Eigen::Index row = 0; row < values.rows(); ++row) {
    const double phase = std::fmod(times[static_cast<std::size_t>(row)] + 1e-9, 1.6);
    if (phase < 1.03 || phase > 1.57) continue;
    EXPECT_EQ(counted(row, 0), 0.0);
    const double effort = residuals.recorded()(row, 0), sign = effort > 0.0 ? 1.0 : -1.0;
    if (std::abs(effort) < breakaway - 1e-6) {
      ++within;
      EXPECT_EQ(values(row, 0), 0.0) << effort;
      EXPECT_TRUE(slopes.row(row).isZero(0.0));
    } else if (std::abs(effort) > breakaway + 1e-6) {
      ++outside;
      EXPECT_NEAR(values(row, 0), sign * breakaway - effort, 1e-6);
      EXPECT_NEAR(slopes(row, 0), 0.0, 1e-6);
      EXPECT_NEAR(slopes(row, 1), sign * kSpeed, 1e-9);
      EXPECT_NEAR(slopes(row, 2), sign, 1e-6);
    }
  }
  EXPECT_GT(within, 100);
  EXPECT_GT(outside, 100);
}

/// Differences of two steps, of residuals that the filter has passed.
TEST(RestBounds, SlopesBehindAFilterAreThoseOfDifferences) {
  const Problem problem = arm("cutoff: 0, residual_cutoff: 12, decimate: 3");
  const FitVariables variables(study_of(problem), &robot_of(problem));
  const std::vector<JointRecording> recordings = {recording(1.5, RestRule::kBounds, 0.05)};
  const FilterOptions& filter = study_of(problem).identification->filter;
  Warnings warnings;
  EffortResiduals residuals(*system_of(problem), variables, require_same_joints(recordings),
                            {measured_motion(recordings[0], filter, &warnings)}, filter, 1);
  const Eigen::Vector3d x(0.25, 0.5, 0.8);
  ASSERT_TRUE(residuals.begin(x).ok());
  Eigen::MatrixXd values, slopes, one, other;
  ASSERT_TRUE(residuals.evaluate(x, &values, &slopes).ok());
  constexpr double kStep = 1e-6;
  int outside = 0;
  const Eigen::MatrixXd counted = residuals.counted();
  for (Eigen::Index k = 0; k < 3; ++k) {
    ASSERT_TRUE(residuals.evaluate(x + kStep * Eigen::Vector3d::Unit(k), &one, nullptr).ok());
    ASSERT_TRUE(residuals.evaluate(x - kStep * Eigen::Vector3d::Unit(k), &other, nullptr).ok());
    for (Eigen::Index row = 0; row < values.rows(); ++row)
      if (one(row, 0) * other(row, 0) != 0.0) {  // no bound is crossed
        EXPECT_NEAR(slopes(row, k), (one(row, 0) - other(row, 0)) / (2.0 * kStep), 1e-6);
        if (counted(row, 0) == 0.0) ++outside;
      }
  }
  EXPECT_GT(outside, 100);
}

TEST(RestBounds, FailuresNameTheMeasuredSample) {
  const Problem problem = arm("cutoff: 0");
  MotionSamples measured;
  measured.position = measured.velocity = measured.acceleration = Eigen::MatrixXd::Zero(1, 10);
  Eigen::MatrixXd speeds = Eigen::MatrixXd::Zero(1, 10);
  speeds(0, 2) = speeds(0, 4) = 0.1;
  measured.position(0, 7) = std::nan("");
  EffortModel model(*system_of(problem), {{"hinge", true, 1.0, {}}},
                    RestBounds(measured, speeds).samples());
  const Status status = model.begin(system_of(problem)->parameters());
  EXPECT_FALSE(status.ok());
  EXPECT_EQ(status.cause.find("sample 7: "), 0U) << status.cause;
}

TEST(RestBounds, OfTwoRecordingsAreThoseOfEach) {
  const Problem problem = arm("cutoff: 0, residual_cutoff: 12, decimate: 3");
  const FitVariables variables(study_of(problem), &robot_of(problem));
  const FilterOptions& filter = study_of(problem).identification->filter;
  const std::vector<JointRecording> recordings = {recording(1.5, RestRule::kBounds),
                                                  recording(1.2, RestRule::kLeaveOut),
                                                  recording(1.3, RestRule::kBounds)};
  const Eigen::Vector3d x(0.25, 0.5, 0.8);
  const auto residuals_of = [&](const std::vector<JointRecording>& of, Eigen::MatrixXd* slopes) {
    Warnings warnings;
    std::vector<MeasuredMotion> motions;
    for (const JointRecording& each : of)
      motions.push_back(measured_motion(each, filter, &warnings));
    EffortResiduals residuals(*system_of(problem), variables, require_same_joints(of), motions,
                              filter, 1);
    Eigen::MatrixXd values;
    EXPECT_TRUE(residuals.begin(x).ok());
    EXPECT_TRUE(residuals.evaluate(x, &values, slopes).ok());
    return values;
  };
  Eigen::MatrixXd all_slopes, slopes;
  const Eigen::MatrixXd all = residuals_of(recordings, &all_slopes);
  Eigen::Index row = 0;
  for (const JointRecording& each : recordings) {
    const Eigen::MatrixXd values = residuals_of({each}, &slopes);
    EXPECT_LT((all.middleRows(row, values.rows()) - values).norm(), 1e-9);
    EXPECT_LT((all_slopes.middleRows(row, values.rows()) - slopes).norm(), 1e-9);
    row += values.rows();
  }
  EXPECT_EQ(row, all.rows());
}

/// Rests outside of the bounds are part of the fit, not of the variance of its residuals: inertia,
/// which they do not tell, is as well known as moving samples fit.
TEST(RestBounds, ResidualsOfMovingSamplesDecideIntervals) {
  const std::string white = "cutoff: 0}\n  intervals: {noise: white";
  const auto deviation_over_rms = [&](double swing) {
    const IdentificationResult result = fit(swing, white, RestRule::kBounds, 0.05);
    EXPECT_TRUE(result.status.ok());
    return result.numbers[0].deviation / result.data[0].rms;
  };
  EXPECT_NEAR(deviation_over_rms(kCoulomb + 0.3) / deviation_over_rms(0.3), 1.0, 0.1);
}

TEST(RestBounds, EffortsWithinThemLeaveTheFit) {
  for (const std::string filter : {"cutoff: 0", "cutoff: 0, residual_cutoff: 15, decimate: 2"}) {
    const IdentificationResult result = fit(0.7, filter, RestRule::kBounds);
    ASSERT_TRUE(result.status.ok()) << result.status.cause;
    EXPECT_NEAR(result.numbers[0].value, kInertia - 0.5, 4e-3) << filter;
    EXPECT_NEAR(result.numbers[1].value, kViscous, 4e-3) << filter;
    EXPECT_NEAR(result.numbers[2].value, kCoulomb, 4e-3) << filter;
    EXPECT_LT(result.data[0].counted, 0.65);
    EXPECT_GT(result.data[0].counted, 0.4);
  }
}

/// Efforts that hold the joint still tell that friction is at least as large: of a motion that
/// tells friction badly, bounds tell more than samples that are left out.
TEST(RestBounds, EffortsBeyondThemRaiseFriction) {
  const double swing = kCoulomb + 0.3;
  const IdentificationResult left_out = fit(swing, "cutoff: 0", RestRule::kLeaveOut),
                             bounded = fit(swing, "cutoff: 0", RestRule::kBounds);
  EXPECT_NEAR(left_out.numbers[2].value, kCoulomb, 4e-3);
  EXPECT_GT(bounded.numbers[2].value, kCoulomb + 0.02);
  EXPECT_LT(bounded.numbers[2].value, swing);
}

}  // namespace
}  // namespace codesign
