// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
// The numbers are in doc/case_studies.md.
#include <algorithm>
#include <cmath>

#include "cases/shipped.h"
#include "mechanism_codesign/optimization.h"

namespace codesign {
namespace {

/// The limits of the case in the order of its `path`: efforts of shoulder and elbow [N m], speeds
/// of shoulder and elbow [rad/s].
const std::vector<double> kLimits{18.0, 5.8, 2.25, 2.5};

double magnitude(const WatchedResult& watched) {
  return std::max(std::abs(watched.smallest), std::abs(watched.largest));
}

TEST(ArmLimits, TheBoundsAreTheLimitsOfTheUrdf) {
  const Shipped shipped("arm_limits");
  const std::vector<WatchedSignal>& watched = shipped.study.watched;
  ASSERT_EQ(watched.size(), kLimits.size());
  for (std::size_t k = 0; k < watched.size(); ++k) {
    EXPECT_EQ(watched[k].role, WatchedSignal::Role::kPath);
    ASSERT_TRUE(watched[k].lower && watched[k].upper);
    EXPECT_EQ(watched[k].upper->at(shipped.parameters()), kLimits[k]) << watched[k].signal.text;
    EXPECT_EQ(watched[k].lower->at(shipped.parameters()), -kLimits[k]) << watched[k].signal.text;
  }
  std::vector<double> limits;
  for (const JointDescription& joint : shipped.robot.joints)
    if (joint.limit) limits.push_back(joint.limit->effort.nominal());
  for (const JointDescription& joint : shipped.robot.joints)
    if (joint.limit) limits.push_back(joint.limit->velocity.nominal());
  EXPECT_EQ(limits, kLimits);
}

TEST(ArmLimits, TheTunedArmKeepsItsLimitsAtAllTimes) {
  const Problem problem = shipped_problem("arm_limits", {});
  const OptimizationResult result = optimize(problem);
  ASSERT_TRUE(result.status.ok()) << result.status.cause;
  EXPECT_NEAR(result.best.objective, 2.79816, 1e-4);
  EXPECT_LE(result.cost.evaluations, 40);
  ASSERT_EQ(result.constraints.watched.size(), kLimits.size());
  for (const WatchedResult& watched : result.constraints.watched)
    EXPECT_LE(watched.violation, 1e-8) << watched.signal;
  EXPECT_NEAR(magnitude(result.constraints.watched[0]), 18.0, 1e-6) << "the bound is active";
  // Samples of the same design stay within the limits, too.
  std::vector<std::string> signals;
  for (const WatchedResult& watched : result.constraints.watched) signals.push_back(watched.signal);
  Simulation simulation(problem, problem.parameters(result.best.rho), signals);
  const Status status = simulate(&simulation, 2.0, 1001, [&](const Frame& frame) {
    for (std::size_t k = 0; k < kLimits.size(); ++k)
      EXPECT_LE(std::abs(frame.signals[k]), kLimits[k] + 1e-6)
          << signals[k] << " at " << frame.time;
    return true;
  });
  EXPECT_TRUE(status.ok()) << status.cause;
}

TEST(ArmLimits, WithoutLimitsTheSameTuningExceedsAllOfThem) {
  const OptimizationResult result =
      optimize(shipped_problem("arm_limits", {}, {{"limit_share", 100.0}}));
  ASSERT_TRUE(result.status.ok()) << result.status.cause;
  EXPECT_NEAR(result.best.objective, 1.49643, 1e-3);
  ASSERT_EQ(result.constraints.watched.size(), kLimits.size());
  for (std::size_t k = 0; k < kLimits.size(); ++k)
    EXPECT_GT(magnitude(result.constraints.watched[k]), kLimits[k])
        << result.constraints.watched[k].signal;
}

TEST(ArmLimits, OtherAlgorithmsEndAtTheSamePoint) {
  for (const char* algorithm : {"mma", "ccsaq"}) {
    const OptimizationResult result = optimize(shipped_problem(
        "arm_limits", {{"algorithm: slsqp", std::string("algorithm: ") + algorithm}}));
    ASSERT_TRUE(result.status.ok()) << algorithm << ": " << result.status.cause;
    EXPECT_NEAR(result.best.objective, 2.79816, 1e-3) << algorithm;
  }
}

}  // namespace
}  // namespace codesign
