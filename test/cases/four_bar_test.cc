// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
// Synthesis of linkages by postures.
#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>

#include "cases/shipped.h"
#include "mechanism_codesign/optimization.h"
#include "optimization/search_hooks.h"
#include "sensitivity/postures.h"
#include "text/number_text.h"

namespace codesign {
namespace {

constexpr double kPi = 3.141592653589793;

struct Links {
  double a, b, c;
};

/// Freudenstein's equation K1 cos psi - K2 cos phi + K3 = cos(phi - psi) at three positions, with
/// K1 = 1/a, K2 = 1/c, K3 = (1 + a^2 - b^2 + c^2) / (2 a c) for pivots 1 m apart.
Links freudenstein(const Eigen::Vector3d& phi, const Eigen::Vector3d& psi) {
  Eigen::Matrix3d left;
  left << psi.array().cos(), -phi.array().cos(), Eigen::Vector3d::Ones();
  const Eigen::Vector3d K = left.partialPivLu().solve((phi - psi).array().cos().matrix());
  const double a = 1.0 / K[0], c = 1.0 / K[1];
  return {a, std::sqrt(1.0 + a * a + c * c - 2.0 * a * c * K[2]), c};
}

std::string list(const Eigen::Vector3d& numbers) {
  return "[" + to_decimal(numbers[0]) + ", " + to_decimal(numbers[1]) + ", " +
         to_decimal(numbers[2]) + "]";
}

// 60 degrees times sin x while the crank turns by 120 degrees for x from 0 to 90 degrees.
Eigen::Vector3d crank_at(const Eigen::Vector3d& x) {
  return 97.0 * kPi / 180.0 + 4.0 / 3.0 * x.array();
}
Eigen::Vector3d rocker_at(const Eigen::Vector3d& x) { return kPi / 3.0 * (1.0 + x.array().sin()); }
/// Chebyshev's spacing of three points between 0 and 90 degrees.
Eigen::Vector3d chebyshev() {
  const double part = std::cos(kPi / 6.0);
  return kPi / 4.0 * Eigen::Vector3d(1.0 - part, 1.0, 1.0 + part);
}

TEST(FourBarFunction, ThreePositionsHaveFreudensteinsLinks) {
  const Eigen::Vector3d crank = crank_at(chebyshev()), rocker = rocker_at(chebyshev());
  const Links exact = freudenstein(crank, rocker);
  EXPECT_NEAR(exact.a, 0.5546, 1e-4);
  const Problem problem = postures(
      "four_bar_function",
      "positions: {crank_joint: " + list(crank) +
          "}\ninitial_state: {rocker_joint: {guess: 1.0}}\nparameters: {a: {initial: 0.6}, b: "
          "{initial: 1.4}, c: {initial: 0.8}}\nobjective: {sum: [{signal: rocker_joint/position, "
          "reference: " +
          list(rocker) + "}]}\noptimizer: {relative_tolerance: 1.0e-12}\n");
  const OptimizationResult result = optimize(problem);
  ASSERT_TRUE(result.status.ok()) << result.status.cause;
  EXPECT_LT(result.best.objective, 1e-20);
  EXPECT_NEAR(result.best.rho[0], exact.a, 1e-9);
  EXPECT_NEAR(result.best.rho[1], exact.b, 1e-9);
  EXPECT_NEAR(result.best.rho[2], exact.c, 1e-9);
}

// The start of the shipped case is Freudenstein's linkage of the test above.
TEST(FourBarFunction, BeatsThreePrecisionPoints) {
  const Shipped shipped("four_bar_function");
  const OptimizationResult squares =
      optimize(make_system(shipped.robot, shipped.study), shipped.study.optimizer);
  ASSERT_TRUE(squares.status.ok()) << squares.status.cause;
  EXPECT_LT(squares.best.objective, 0.2 * squares.initial.objective);
}

TEST(FourBarPath, IsNearerToThePointsThanThePublishedLinkages) {
  const Shipped shipped("four_bar_path");
  const OptimizationResult result =
      optimize(make_system(shipped.robot, shipped.study), shipped.study.optimizer);
  ASSERT_TRUE(result.status.ok()) << result.status.cause;
  // Kunjur and Krishnamurty (1997) report 0.043, Cabrera et al. (2002) 0.034.
  EXPECT_LT(result.best.objective, 0.011);
  for (double margin : result.constraints.margins) EXPECT_GE(margin, -1e-9);
}

TEST(SixBarDwell, RestsWhileTheCrankTurnsBy100Degrees) {
  const Shipped shipped("six_bar_dwell");
  const OptimizationResult result =
      optimize(make_system(shipped.robot, shipped.study), shipped.study.optimizer);
  ASSERT_TRUE(result.status.ok()) << result.status.cause;
  EXPECT_LT(result.best.objective, 0.01 * result.initial.objective);
  ASSERT_EQ(result.constraints.watched.size(), 2U);
  EXPECT_GE(result.constraints.watched[0].smallest, 0.5 - 1e-6) << "the swing in a whole turn";
}

}  // namespace
}  // namespace codesign
