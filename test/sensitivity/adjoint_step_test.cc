// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include "integration/servo.h"
#include "integration/tableaus.h"
#include "sensitivity/adjoint_step.h"
#include "sensitivity/servo_steps.h"

namespace codesign {
namespace {

constexpr int kPairs = 3;

TEST(MatrixWeights, AreTheSumOfTheOuterProducts) {
  const auto system = servo("{}");
  const IncrementLayout at(system->layout());
  MatrixWeights weights(*system, kPairs + 1);
  std::vector<VectorX<double>> u, mu;
  double next = 0.3;
  const auto fill = [&next](VectorX<double> x) {
    for (double& entry : x) entry = std::sin(next += 1.7);
    return x;
  };
  for (int k = 0; k < kPairs; ++k) {
    u.push_back(fill(VectorX<double>::Zero(at.size())));
    mu.push_back(fill(VectorX<double>::Zero(at.z_size + 1)));
    weights.set(k, u.back(), mu.back());
  }
  const ByVariable<std::vector<double>>& all = weights.compute();
  const auto check = [&](const Sparsity& pattern, const std::vector<double>& found, int first) {
    for (int row = 0; row < pattern.rows; ++row)
      for (int e = pattern.first(row); e < pattern.first(row + 1); ++e) {
        double sum = 0.0;
        for (std::size_t k = 0; k < kPairs; ++k)
          sum += mu[k][row] * u[k][first + pattern.column(e)];
        EXPECT_NEAR(found[static_cast<std::size_t>(e)], sum, 1e-15 * kPairs);
      }
  };
  check(system->patterns().position, all.position, at.x());
  check(system->patterns().velocity, all.velocity, at.v());
  check(system->patterns().rate, all.rate, at.z());
  weights.clear();
  for (double w : weights.compute().rate) EXPECT_EQ(w, 0.0);
}

constexpr int kStart = 3;  // the parameter that moves the initial state alone

class AdjointStepTest : public ::testing::TestWithParam<const RosenbrockTableau*> {};

// psi_y y_rho is the same at either end of the steps.
TEST_P(AdjointStepTest, IsTheTransposedTangent) {
  ServoSteps run(*GetParam());
  const VectorX<double> begin = run.begin.row(kStart).transpose(),
                        end = run.end.row(kStart).transpose();
  EXPECT_GT(end.norm(), 0.1);
  for (Eigen::Index component = 0; component < end.size(); ++component) {
    const VectorX<double>& first =
        run.back(VectorX<double>::Unit(end.size(), component), [](std::size_t) {});
    const double scale = first.cwiseAbs().dot(begin.cwiseAbs());
    EXPECT_NEAR(first.dot(begin), end[component], 1e-12 * (1.0 + scale)) << component;
  }
}

// psi_rho = psi_y y_rho at the start + the products by parameters of all evaluations, for the gains
// and the weight.
TEST_P(AdjointStepTest, TheParametersExplainWhatTheStartDoesNot) {
  ServoSteps run(*GetParam());
  const Eigen::Index size = run.end.cols(), psi = size - 1;
  const VectorX<double>& start = run.back(VectorX<double>::Unit(size, psi), [](std::size_t) {});
  Eigen::VectorXd gradient = Eigen::VectorXd::Zero(5);
  run.adjoint.add_gradient(gradient);
  for (Eigen::Index k = 0; k < 5; ++k) {
    const VectorX<double> begin = run.begin.row(k).transpose();
    const double expected = run.end(k, psi);
    EXPECT_NEAR(gradient[k] + start.dot(begin), expected, 1e-12 * std::abs(expected)) << k;
  }
  // All parameters act on the motion or the integrand, except for the position of the start.
  for (Eigen::Index k : {0, 1, 2, 4}) EXPECT_NE(gradient[k], 0.0) << k;
  EXPECT_EQ(gradient[3], 0.0);
}

INSTANTIATE_TEST_SUITE_P(Methods, AdjointStepTest, ::testing::ValuesIn(all_tableaus()),
                         tableau_name);

}  // namespace

}  // namespace codesign
