// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "excitation/information.h"

#include <gtest/gtest.h>

#include <cmath>

#include "description/study.h"
#include "equations/equations.h"
#include "excitation/excited_cases.h"
#include "math/differences.h"
#include "problem/load_problem.h"

namespace codesign {
namespace {

constexpr double kStep = 0.05;

/// A response of one joint by two parameters, made up.
PathResponse made_up() {
  constexpr int kSamples = 40;
  PathResponse response;
  response.effort.resize(1, kSamples);
  response.jacobian.resize(kSamples, 2);
  for (int k = 0; k < kSamples; ++k) {
    response.effort(0, k) = 3.0 + std::sin(0.3 * k) + 0.2 * std::cos(0.9 * k);
    response.jacobian(k, 0) = std::cos(0.4 * k);
    response.jacobian(k, 1) = 1.0 + 0.5 * std::sin(0.7 * k);
  }
  return response;
}

class InformationOfAPendulum : public testing::Test {
 protected:
  const Problem problem_ =
      excited_pendulum("", "parameters: {inertia: {}, viscous: {}}", "0 1 0",
                       "joints: {hinge: {effort_scale: {initial: 2.0}, delay: "
                       "{initial: 0.01, upper: 0.02}, offset: {initial: 0.5}}}");
  const FitVariables variables_{study_of(problem_)};
  const Information information_{variables_, {"hinge"}, Eigen::VectorXd::Constant(1, 0.1)};
};

TEST_F(InformationOfAPendulum, RowsAreResidualsInUnitsOfTheNoise) {
  const PathResponse response = made_up();
  const Eigen::MatrixXd J = information_.jacobian(response, kStep);
  ASSERT_EQ(J.rows(), 40);
  ASSERT_EQ(J.cols(), 5);
  EXPECT_NEAR(J(7, 0), response.jacobian(7, 0) / 0.1, 1e-12);
  EXPECT_NEAR(J(7, 2), -(response.effort(0, 7) + 0.5) / 2.0 / 0.1, 1e-12) << "scale";
  const double slope = (response.effort(0, 8) - response.effort(0, 6)) / (2.0 * kStep);
  EXPECT_NEAR(J(7, 3), -slope / 0.1, 1e-9) << "delay";
  EXPECT_NEAR(J(7, 4), 10.0, 1e-12) << "offset";
}

TEST_F(InformationOfAPendulum, DerivativesByAResponse) {
  const std::vector<int> columns = {0, 1, 2, 3, 4};
  PathResponse response = made_up();
  Eigen::MatrixXd by_jacobian;
  information_criterion(information_.jacobian(response, kStep), columns, &by_jacobian);
  const Information::ByResponse by = information_.by_response(by_jacobian, 40, kStep);
  for (const Eigen::Index k : {0, 1, 2, 20, 37, 38, 39}) {
    const auto by_effort = [&](double change) {
      PathResponse changed = response;
      changed.effort(0, k) += change;
      return information_criterion(information_.jacobian(changed, kStep), columns, nullptr);
    };
    EXPECT_NEAR(by.effort(0, k), ridders_derivative(by_effort, 0.0, 0.01).value, 1e-8) << k;
    for (const Eigen::Index p : {0, 1}) {
      const auto by_entry = [&](double change) {
        PathResponse changed = response;
        changed.jacobian(k, p) += change;
        return information_criterion(information_.jacobian(changed, kStep), columns, nullptr);
      };
      EXPECT_NEAR(by.jacobian(k, p), ridders_derivative(by_entry, 0.0, 0.01).value, 1e-8);
    }
  }
}

TEST(InformationCriterion, IsTheLogarithmOfTheDeterminant) {
  Eigen::MatrixXd J(3, 3);
  J << 1, 2, 7, 0, 3, 7, 4, 0, 7;
  const Eigen::MatrixXd chosen = J.leftCols(2);
  const Eigen::Matrix2d M = chosen.transpose() * chosen;
  EXPECT_NEAR(information_criterion(J, {0, 1}, nullptr),
              -std::log(M(0, 0) * M(1, 1) - M(0, 1) * M(1, 0)), 1e-12);
  EXPECT_EQ(information_criterion(J, {}, nullptr), 0.0) << "nothing is known at once";
}

TEST(InformationCriterion, IsInfiniteWhereColumnsDependOnEachOther) {
  Eigen::MatrixXd J = Eigen::MatrixXd::Random(5, 3);
  J.col(2) = 2.0 * J.col(0);
  EXPECT_TRUE(std::isinf(information_criterion(J, {0, 1, 2}, nullptr)));
  EXPECT_TRUE(std::isfinite(information_criterion(J, {0, 1}, nullptr)));
  J.col(1).setZero();
  EXPECT_TRUE(std::isinf(information_criterion(J, {0, 1}, nullptr)));
}

TEST(InformationCriterion, UnitsOfParametersAreAConstant) {
  const Eigen::MatrixXd J = Eigen::MatrixXd::Random(6, 2);
  Eigen::MatrixXd scaled = J;
  scaled.col(1) *= 1e-8;
  EXPECT_NEAR(
      information_criterion(scaled, {0, 1}, nullptr) - information_criterion(J, {0, 1}, nullptr),
      16.0 * std::log(10.0), 1e-9);
}

}  // namespace
}  // namespace codesign
