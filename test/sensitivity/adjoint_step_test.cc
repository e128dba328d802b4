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

INSTANTIATE_TEST_SUITE_P(Methods, AdjointStepTest, ::testing::Values("rodas4", "rodas4p2", "rodas5p"),
                         [](const auto& instance) { return std::string(instance.param); });

}  // namespace
}  // namespace codesign
