// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "sensitivity/adjoint_step.h"

#include "sensitivity/servo_steps.h"

namespace codesign {
namespace {

constexpr int kStart = 3;  // the parameter that moves the initial state alone

class AdjointStepTest : public ::testing::TestWithParam<const char*> {};

// psi_y y_rho is the same at either end of the steps.
TEST_P(AdjointStepTest, IsTheTransposedTangent) {
  ServoSteps run(GetParam());
  const VectorX<double> begin = run.begin.row(kStart).transpose(), end = run.end.row(kStart).transpose();
  EXPECT_GT(end.norm(), 0.1);
  for (Eigen::Index component = 0; component < end.size(); ++component) {
    const VectorX<double>& first = run.back(VectorX<double>::Unit(end.size(), component), [](std::size_t) {});
    const double scale = first.cwiseAbs().dot(begin.cwiseAbs());
    EXPECT_NEAR(first.dot(begin), end[component], 1e-12 * (1.0 + scale)) << component;
  }
}

// psi_rho = psi_y y_rho at the start + the products by parameters of all evaluations, for the gains and the weight.
TEST_P(AdjointStepTest, TheParametersExplainWhatTheStartDoesNot) {
  ServoSteps run(GetParam());
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

INSTANTIATE_TEST_SUITE_P(Methods, AdjointStepTest, ::testing::Values("rodas4", "rodas4p2", "rodas5p", "dopri5"),
                         [](const auto& instance) { return std::string(instance.param); });

}  // namespace
}  // namespace codesign
