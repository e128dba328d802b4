// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "cases/shipped.h"
#include "description/study.h"
#include "linear/equilibrium.h"
#include "mechanism_codesign/optimization.h"
#include "problem/load_problem.h"
#include "statics/posture_efforts.h"

namespace codesign {
namespace {

// Springs without free length from A_i to the point b along the arm pull with the torque
// b u x sum k_i A_i, gravity with -m g l u x z: balance is sum k_i b A_i = m g l z.
constexpr double kSecond = 2.0 * 100.0;  // k_1 0.1 = k_2 0.05
constexpr double kHeight = 3.0 * 9.81 * 0.5 / ((100.0 + kSecond) * 0.25);

double largest_effort(const Problem& problem) {
  const PostureGrid& grid = study_of(problem).grid;
  PostureStatics statics(*system_of(problem), grid, problem.parameters(), {});
  EXPECT_TRUE(statics.begin(posture(grid, 0)).ok());
  double largest = 0.0;
  Frame frame;
  std::vector<PostureEffort> efforts;
  for (std::size_t k = 0; k < count_postures(grid); ++k) {
    EXPECT_TRUE(statics.show(posture(grid, k), &frame, &efforts).ok());
    largest = std::max(largest, std::abs(efforts[0].rest));
  }
  return largest;
}

TEST(GravityBalance, TheOptimumIsTheClosedForm) {
  const OptimizationResult result = optimize(shipped_problem("gravity_balance", {}));
  ASSERT_TRUE(result.status.ok()) << result.status.cause;
  ASSERT_EQ(result.best.rho.size(), 2);
  EXPECT_NEAR(result.best.rho[0], kSecond, 1e-9 * kSecond);
  EXPECT_NEAR(result.best.rho[1], kHeight, 1e-9 * kHeight);
}

TEST(GravityBalance, ABalancedArmNeedsNoTorqueAndRestsAnywhere) {
  const Problem start = shipped_problem("gravity_balance", {});
  EXPECT_GT(largest_effort(start), 1.0);
  const Problem balanced =
      shipped_problem("gravity_balance", {}, {{"second_stiffness", kSecond}, {"height", kHeight}});
  EXPECT_LT(largest_effort(balanced), 1e-9);
  const Problem left_alone =
      load_problem(read_source(source_dir() + "/urdf/gravity_balance.urdf"), {},
                   {"rest.yaml", "duration: 0.5\ninitial_state: {hinge: {position: 0.5}}\n"},
                   {{"second_stiffness", kSecond}, {"height", kHeight}});
  const Equilibrium found = find_equilibrium(*system_of(left_alone), left_alone.parameters(), {});
  ASSERT_TRUE(found.status.ok()) << found.status.cause;
  EXPECT_EQ(found.linear.stability, Stability::kNeutral);
  EXPECT_NEAR(found.frame.joints[0].position, 0.5, 1e-9);
}

}  // namespace
}  // namespace codesign
