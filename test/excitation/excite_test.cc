// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "excitation/excite.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "description/study.h"
#include "excitation/excited_cases.h"
#include "identification/identify.h"
#include "problem/load_problem.h"

namespace codesign {
namespace {

const PredictedNumber& number_of(const ExcitationResult& result, const std::string& name) {
  for (const PredictedNumber& number : result.numbers)
    if (number.name == name) return number;
  ADD_FAILURE() << "no " << name;
  return result.numbers.front();
}

void expect_limits_kept(const ExcitationResult& result) {
  for (const KeptLimit& limit : result.limits) {
    EXPECT_GE(limit.reached.lowest, limit.limits.lower) << limit.limits.name;
    EXPECT_LE(limit.reached.highest, limit.limits.upper) << limit.limits.name;
  }
}

/// The largest |z| of all limited signals at many equal steps of the trajectory found, recomputed
/// from its coefficients.
double worst_on_fine_scan(const Problem& problem, const ExcitationResult& result, int count) {
  const MotionLimits limits = motion_limits(problem);
  const TrajectoryBasis basis(*study_of(problem).excitation);
  const SampledShapes shapes(basis, times_in_period(basis.period(), count));
  DrivePath path{(shapes.value * result.coefficients).transpose(),
                 (shapes.rate * result.coefficients).transpose(),
                 (shapes.acceleration * result.coefficients).transpose()};
  path.position.colwise() += result.rest;
  ExcitedMotion motion(*system_of(problem), limits.joints, limits.followers, problem.parameters(),
                       1);
  EXPECT_TRUE(motion.begin(result.rest).ok());
  return worst_along(limits, path, &motion);
}

TEST(Excite, APendulumIsKnownBetterWithinItsLimits) {
  const Problem problem = excited_pendulum("starts: 3");
  const ExcitationResult result = excite(problem, {}, nullptr);
  ASSERT_TRUE(result.status.ok()) << result.status.cause;
  RecordProperty("volume_factor", std::to_string(result.volume_factor()));
  EXPECT_GT(result.volume_factor(), 5.0);
  EXPECT_EQ(result.counted, 4);
  EXPECT_EQ(result.starts.size(), 3U);
  expect_limits_kept(result);
  EXPECT_LE(worst_on_fine_scan(problem, result, 100000), 1.0 + 1e-9);
  for (const PredictedNumber& number : result.numbers)
    EXPECT_LT(number.half, number.half_before) << number.name;
}

TEST(Excite, WaypointsBeginAndEndAtRest) {
  const ExcitationResult result = excite(
      excited_pendulum("starts: 1, periods: 2, max_evaluations: 10, sample_rate: 50"), {}, nullptr);
  const TrajectoryPoints& points = result.points;
  ASSERT_EQ(points.times.size(), 401U);
  EXPECT_EQ(points.joints, (std::vector<std::string>{"hinge"}));
  for (const Eigen::Index k : {0, 200, 400}) {
    EXPECT_NEAR(points.position(0, k), points.position(0, 0), 1e-12);
    EXPECT_NEAR(points.velocity(0, k), 0.0, 1e-12);
    EXPECT_NEAR(points.acceleration(0, k), 0.0, 1e-9);
  }
  EXPECT_GT(points.velocity.cwiseAbs().maxCoeff(), 1.0);
}

TEST(Excite, AnArmByBothKindsOfTrajectories) {
  for (const std::string kind : {"harmonics: 4", "trajectory: spline, knots: 12"}) {
    const Problem problem = arm("starts: 2, max_evaluations: 120, " + kind);
    const ExcitationResult result = excite(problem, {}, nullptr);
    ASSERT_TRUE(result.status.ok()) << result.status.cause;
    RecordProperty("volume_factor_" + kind.substr(0, 5), std::to_string(result.volume_factor()));
    EXPECT_GT(result.volume_factor(), 10.0) << kind;
    expect_limits_kept(result);
    EXPECT_LE(worst_on_fine_scan(problem, result, 50000), 1.0 + 1e-9) << kind;
  }
}

TEST(Excite, ASearchThatEndsBeyondTheLimitsIsNotLost) {
  const ExcitationResult result =
      excite(arm("starts: 1, max_evaluations: 24, harmonics: 4"), {}, nullptr);
  ASSERT_TRUE(result.status.ok()) << result.status.cause;
  EXPECT_LE(result.starts[0].criterion, result.starts[0].initial_criterion);
  EXPECT_GT(result.volume_factor(), 1.5);
  expect_limits_kept(result);
}

TEST(Excite, AClosedLoopKeepsTheLimitsOfJointsThatFollow) {
  const Problem problem = slider_crank("  harmonics: 4\n  starts: 2\n  max_evaluations: 80\n");
  const ExcitationResult result = excite(problem, {}, nullptr);
  ASSERT_TRUE(result.status.ok()) << result.status.cause;
  EXPECT_GT(result.volume_factor(), 1.2);
  expect_limits_kept(result);
  EXPECT_LE(worst_on_fine_scan(problem, result, 20000), 1.0 + 1e-9);
}

/// A crank, a rod and a block on a slide of the ground, whose crank is moved.
Problem planar_slider_crank(bool in_plane) {
  std::string urdf = file_text("test/features/planar_loop.urdf");
  const std::string held = " codesign:out_of_plane=\"zero\"";
  if (!in_plane) urdf.erase(urdf.find(held), held.size());
  return load_problem(
      {"linkage.urdf", urdf}, {},
      {"study.yaml",
       "gravity: [0, -9.81, 0]\ninitial_state: {crank_joint: {position: 0.9}, rod_joint: {guess: "
       "-1.1}, block_joint: {guess: 0.2}}\nidentify: {}\nexcite: {joints: {crank_joint: {position: "
       "[-0.6, 2.4], velocity: 3.0, effort: 20.0, noise: 0.1}}, limits: {rod_joint: {velocity: "
       "2.5}}, period: 3.0, harmonics: 4, starts: 1, max_evaluations: 60}\nparameters: {crank: {}, "
       "rod: {}, mu: {}}\n"});
}

// The linkage is loaded in its plane, so that the same motion tells the same of both; the searches
// end at different motions.
TEST(Excite, ALoopThatIsHeldInItsPlane) {
  const Problem problem = planar_slider_crank(true);
  const ExcitationResult result = excite(problem, {}, nullptr),
                         shared = excite(planar_slider_crank(false), {}, nullptr);
  ASSERT_TRUE(result.status.ok()) << result.status.cause;
  ASSERT_TRUE(shared.status.ok()) << shared.status.cause;
  EXPECT_GT(result.volume_factor(), 1.2);
  expect_limits_kept(result);
  EXPECT_LE(worst_on_fine_scan(problem, result, 20000), 1.0 + 1e-9);
  for (const PredictedNumber& number : result.numbers)
    EXPECT_NEAR(number.half_before / number_of(shared, number.name).half_before, 1.0, 1e-6)
        << number.name;
}

TEST(Excite, WhatNoTrajectoryTellsIsNamed) {
  const ExcitationResult result =
      excite(excited_pendulum("starts: 1, max_evaluations: 40",
                              "parameters: {mass: {}, inertia: {}, viscous: {}}", "0 0 1"),
             {}, nullptr);
  EXPECT_EQ(result.status.code, StatusCode::kNotIdentifiable);
  ASSERT_EQ(result.undetermined.size(), 1U);
  EXPECT_NE(result.undetermined[0].find("mass"), std::string::npos) << result.undetermined[0];
  EXPECT_NE(result.undetermined[0].find("inertia"), std::string::npos);
  EXPECT_NE(result.status.cause.find(result.undetermined[0]), std::string::npos);
  EXPECT_FALSE(number_of(result, "mass").is_determined);
  EXPECT_TRUE(std::isinf(number_of(result, "mass").half));
  EXPECT_TRUE(std::isfinite(number_of(result, "viscous").half));
  EXPECT_EQ(result.counted, 2);
  EXPECT_GT(result.volume_factor(), 1.0) << "the rest is excited all the same";
  EXPECT_GT(result.points.times.size(), 100U);
}

TEST(Excite, AMassOnTheAxisHasNoEffect) {
  const Problem problem = load_problem(
      {"pendulum.urdf", pendulum_urdf("0 0 1", "0 0 -0.5")}, {},
      {"study.yaml",
       "identify: {}\nexcite: {joints: {hinge: {noise: 0.1}}, starts: 1, max_evaluations: 20}\n"
       "parameters: {mass: {}, inertia: {}, viscous: {}}\n"});
  const ExcitationResult result = excite(problem, {}, nullptr);
  EXPECT_EQ(result.status.code, StatusCode::kNotIdentifiable);
  EXPECT_EQ(result.undetermined, (std::vector<std::string>{"mass has no effect"}));
  EXPECT_TRUE(std::isinf(number_of(result, "mass").half));
  EXPECT_TRUE(std::isfinite(number_of(result, "inertia").half));
}

TEST(Excite, WhatAPriorDecidesIsNoFailure) {
  const auto excited = [](const std::string& prior) {
    return excite(load_problem({"pendulum.urdf", pendulum_urdf("0 0 1", "0 0 -0.5")}, {},
                               {"study.yaml", "identify: {prior: {" + prior +
                                                  ": 0.3}}\nexcite: {joints: {hinge: {noise: "
                                                  "0.1}}, starts: 1, max_evaluations: 20}\n"
                                                  "parameters: {mass: {}, inertia: {}}\n"}),
                  {}, nullptr);
  };
  EXPECT_TRUE(excited("mass").status.ok());
  EXPECT_EQ(excited("mass").undetermined, (std::vector<std::string>{"mass has no effect"}));
  EXPECT_EQ(excited("inertia").status.code, StatusCode::kNotIdentifiable);
}

TEST(Excite, ACancelKeepsTheBestTrajectory) {
  const Problem problem = excited_pendulum("starts: 3");
  std::atomic<bool> cancel{false};
  const auto observer = [&cancel](const ExcitationTrial& trial) {
    if (trial.evaluation == 15) cancel = true;
    return true;
  };
  const ExcitationResult result = excite(problem, observer, &cancel);
  EXPECT_EQ(result.status.code, StatusCode::kCancelled);
  EXPECT_EQ(result.termination, "cancelled");
  EXPECT_EQ(result.starts.size(), 1U);
  EXPECT_LT(result.criterion, result.criterion_before);
  expect_limits_kept(result);
  EXPECT_GT(result.points.times.size(), 100U);
  cancel = true;
  EXPECT_EQ(excite(problem, {}, &cancel).status.code, StatusCode::kCancelled) << "at once";
}

TEST(Excite, TheSameSeedGivesTheSameBits) {
  const Problem one =
      excited_pendulum("starts: 2, max_evaluations: 20",
                       "parameters: {inertia: {}, viscous: {}}\nengine: {type: serial}");
  const Problem four = excited_pendulum(
      "starts: 2, max_evaluations: 20",
      "parameters: {inertia: {}, viscous: {}}\nengine: {type: threads, workers: 4}");
  EXPECT_EQ(excite(one, {}, nullptr).coefficients, excite(four, {}, nullptr).coefficients);
}

TEST(Excite, ARestThatBreaksALimitIsInfeasible) {
  const Problem problem =
      load_problem({"pendulum.urdf", pendulum_urdf()}, {},
                   {"study.yaml",
                    "initial_state: {hinge: {position: 0.5}}\nidentify: {}\nexcite: {joints: "
                    "{hinge: {position: [0.4, 1.0], effort: 2.0, noise: "
                    "1}}}\nparameters: {mass: {}}\n"});
  const ExcitationResult result = excite(problem, {}, nullptr);
  EXPECT_EQ(result.status.code, StatusCode::kInfeasible) << result.status.cause;
  EXPECT_TRUE(result.numbers.empty());
}

/// A rig that moves along the way-points and records them, with noisy efforts.
JointRecording recorded(const TrajectoryPoints& points, double noise, unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal(0.0, noise);
  JointRecording recording;
  recording.file = "rig.csv";
  recording.element = "identify.data[0]";
  recording.where = {"study.yaml", 1};
  recording.times = points.times;
  for (std::size_t k = 0; k < points.times.size(); ++k) recording.places.push_back(k + 2);
  for (std::size_t joint = 0; joint < points.joints.size(); ++joint) {
    JointSamples samples{points.joints[joint], {}, {}, {}};
    const auto row = static_cast<Eigen::Index>(joint);
    for (Eigen::Index k = 0; k < points.position.cols(); ++k) {
      samples.position.push_back(points.position(row, k));
      samples.velocity.push_back(points.velocity(row, k));
      samples.effort.push_back(points.effort(row, k) + normal(random));
    }
    recording.joints.push_back(std::move(samples));
  }
  return recording;
}

TEST(Excite, ARecordingOfTheTrajectoryIsKnownAsPredicted) {
  const Problem problem = arm("harmonics: 4, starts: 1, max_evaluations: 60, sample_rate: 200",
                              "intervals: {noise: white}");
  const ExcitationResult planned = excite(problem, {}, nullptr);
  ASSERT_TRUE(planned.status.ok()) << planned.status.cause;
  for (const bool plain : {false, true}) {
    StudyRecordings recordings;
    recordings.data = {recorded(plain ? planned.before : planned.points, 0.2, 5)};
    const IdentificationResult found = identify(problem, recordings, {}, nullptr);
    ASSERT_TRUE(found.status.ok()) << found.status.cause;
    for (const IdentifiedNumber& number : found.numbers) {
      const PredictedNumber& predicted = number_of(planned, number.name);
      const double deviation = plain ? predicted.deviation_before : predicted.deviation;
      EXPECT_NEAR(number.deviation / deviation, 1.0, 0.15) << number.name;
      EXPECT_LT(std::abs(number.value - predicted.nominal), 4.0 * deviation) << number.name;
    }
  }
}

}  // namespace
}  // namespace codesign
