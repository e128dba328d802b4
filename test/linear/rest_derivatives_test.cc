// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "linear/rest_derivatives.h"

#include <gtest/gtest.h>

#include <cmath>

#include "equations/compiled_system.h"
#include "linear/scaled_solution.h"
#include "statics/linear_cases.h"

namespace codesign {
namespace {

TEST(ScaledSolution, HasTheLeastNormAndTheNullVectors) {
  Eigen::MatrixXd A(2, 3);
  A << 1e6, 0.0, 0.0, 0.0, 1.0, 1.0;
  const ScaledSolution solution(A);
  const Eigen::MatrixXd x = solution.solve(Eigen::Vector2d(2e6, 4.0)), n = solution.null_vectors();
  EXPECT_NEAR((x - Eigen::Vector3d(2.0, 2.0, 2.0)).norm(), 0.0, 1e-12);
  ASSERT_EQ(n.cols(), 1);
  EXPECT_NEAR((A * n).norm(), 0.0, 1e-8) << "of entries of 1e6";
}

// A mass on a spring of 3 N/m and a servo of p = 5 N/m: (3 + 5) x = 5 r + F.
TEST(RestDerivatives, OfADroop) {
  const Problem problem =
      loaded(carts(1, {sprung(3.0)}),
             "parameters: {p: {initial: 5}, r: {initial: 0.4}, F: {initial: 2}}\n"
             "duration: 10\ngravity: [0, 0, 0]\nloads: [{joint: x0, effort: \"${F}\"}]\n"
             "controllers: {servo: {type: pid, input: x0/position, setpoint: \"${r}\", output: x0, "
             "gains: {p: \"${p}\"}}}\n");
  const CompiledSystem& system = *system_of(problem);
  LinearStudy study;
  study.study = system.whole_study();
  RestDerivatives derivatives(system, study);
  State<double> rest;
  rest.resize(system.layout());
  rest.q[0] = (5.0 * 0.4 + 2.0) / 8.0;
  const std::vector<RestDerivatives::Change> changes = derivatives.at(rest, problem.parameters());
  ASSERT_EQ(changes.size(), 3U) << "nothing is undetermined";
  EXPECT_NEAR(changes[0].q[0], (0.4 - 0.5) / 8.0, 1e-13);
  EXPECT_NEAR(changes[1].q[0], 5.0 / 8.0, 1e-13);
  EXPECT_NEAR(changes[2].q[0], 1.0 / 8.0, 1e-13);
}

TEST(RestDerivatives, NamesWhatNothingDetermines) {
  const Problem problem =
      loaded(carts(2, {"", sprung(3.0)}),
             "parameters: {d: {initial: 5}}\nduration: 10\ngravity: [0, 0, 0]\n"
             "controllers: {servo: {type: pid, input: x0/velocity, setpoint: 0, "
             "output: x0, gains: {p: \"${d}\"}}}\n");
  const CompiledSystem& system = *system_of(problem);
  LinearStudy study;
  study.study = system.whole_study();
  RestDerivatives derivatives(system, study);
  State<double> rest;
  rest.resize(system.layout());
  const std::vector<RestDerivatives::Change> changes = derivatives.at(rest, problem.parameters());
  ASSERT_EQ(changes.size(), 2U);
  EXPECT_GT(std::abs(changes[1].q[0]), 0.0);
  EXPECT_NEAR(changes[1].q[1], 0.0, 1e-12);
}

}  // namespace
}  // namespace codesign
