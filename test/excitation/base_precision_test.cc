// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "excitation/base_precision.h"

#include <gtest/gtest.h>

#include <cmath>

#include "description/study.h"
#include "excitation/excite.h"
#include "excitation/excited_cases.h"
#include "problem/load_problem.h"

namespace codesign {
namespace {

/// Columns whose products are known: the first two stand at an angle, the third is twice the first.
TEST(BasePrecision, OfColumnsAtAnAngle) {
  const Problem problem = arm("starts: 1");
  const FitVariables variables(study_of(problem), &robot_of(problem));
  ASSERT_GE(variables.size(), 3);
  Eigen::MatrixXd J = Eigen::MatrixXd::Zero(8, variables.size());
  J(0, 0) = 3.0;
  J(0, 1) = 1.0;
  J(1, 1) = 1.0;
  J.col(2) = 2.0 * J.col(0);
  const BasePrecision precision(variables, J);
  ASSERT_TRUE(precision.has_combinations());
  ASSERT_EQ(precision.names().size(), 2U);
  const BasePrecision::Merit merit = precision.of(J);
  // J^T J of the columns that stand for the base, whichever of the two dependent ones is named.
  const bool is_first = precision.names()[0].rfind(variables.names()[0], 0) == 0;
  const double length = is_first ? 3.0 : 6.0, a = length * length, b = length, d = 2.0,
               middle = 0.5 * (a + d), half = std::sqrt(0.25 * (a - d) * (a - d) + b * b);
  EXPECT_NEAR(merit.condition, std::sqrt((middle + half) / (middle - half)), 1e-9);
  // Their inverse has the diagonal d and a over the determinant.
  const double determinant = a * d - b * b;
  const Eigen::Index at = is_first ? 0 : 1;
  EXPECT_NEAR(merit.deviations[at], std::sqrt(d / determinant), 1e-12);
  EXPECT_NEAR(merit.deviations[1 - at], std::sqrt(a / determinant), 1e-12);
  J.col(1).setZero();
  EXPECT_TRUE(std::isinf(precision.of(J).condition));
}

/// The plain trajectory as a table is predicted as the plain trajectory.
TEST(BasePrecision, AComparedTrajectoryIsJudgedAsItIs) {
  const Problem problem = excited_pendulum("starts: 1, max_evaluations: 5, sample_rate: 200");
  const ExcitationResult once = excite(problem, {}, nullptr);
  EXPECT_FALSE(once.compared);
  EXPECT_TRUE(std::isfinite(once.condition_before));
  JointRecording table;
  table.file = "plain.csv";
  table.element = "--compare";
  table.times = once.before.times;
  JointSamples hinge{"hinge", {}, {}, {}};
  for (Eigen::Index k = 0; k < once.before.position.cols(); ++k) {
    hinge.position.push_back(once.before.position(0, k));
    hinge.velocity.push_back(once.before.velocity(0, k));
  }
  table.joints = {hinge};
  const ExcitationResult result = excite(problem, {}, nullptr, &table);
  ASSERT_TRUE(result.compared);
  ASSERT_TRUE(result.compared->status.ok()) << result.compared->status.cause;
  EXPECT_EQ(result.compared->samples, once.before.position.cols());
  EXPECT_NEAR(result.compared->rate, 200.0, 1e-6);
  EXPECT_NEAR(result.compared->condition, once.condition_before, 0.02 * once.condition_before);
  for (std::size_t k = 0; k < result.numbers.size(); ++k)
    EXPECT_NEAR(result.compared->deviations[static_cast<Eigen::Index>(k)],
                result.numbers[k].deviation_before, 0.02 * result.numbers[k].deviation_before)
        << result.numbers[k].name;
  table.joints[0].position.clear();
  EXPECT_THROW(excite(problem, {}, nullptr, &table), InputError);
}

}  // namespace
}  // namespace codesign
