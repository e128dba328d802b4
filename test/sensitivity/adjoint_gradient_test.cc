// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "sensitivity/adjoint_gradient.h"

#include "sensitivity/gradient_cases.h"
#include "sensitivity/rosenbrock_gradient.h"

namespace codesign {
namespace {

using Parameter = std::tuple<std::size_t, const char*>;

class AdjointGradientTest : public ::testing::TestWithParam<Parameter> {};

TEST_P(AdjointGradientTest, IsTheDirectGradientToRounding) {
  const auto& [index, method] = GetParam();
  const GradientCase test = gradient_cases().at(index);
  const auto system = test.compile(method, "auto");
  RosenbrockGradient direct(*system);
  AdjointGradient adjoint(*system);
  const GradientRun a = run_gradient(&direct, *system, system->parameters()),
                    b = run_gradient(&adjoint, *system, system->parameters());
  ASSERT_TRUE(a.status.ok()) << a.status.cause;
  ASSERT_TRUE(b.status.ok()) << b.status.cause;
  EXPECT_GT(a.steps, 5);
  EXPECT_EQ(a.steps, b.steps);
  EXPECT_EQ(a.objective, b.objective);
  const double largest = a.gradient.cwiseAbs().maxCoeff();
  EXPECT_GT(largest, 0.0);
  for (Eigen::Index k = 0; k < a.gradient.size(); ++k)
    EXPECT_NEAR(b.gradient[k], a.gradient[k],
                1e-10 * std::max(std::abs(a.gradient[k]), 1e-2 * largest))
        << "parameter " << k;
}

INSTANTIATE_TEST_SUITE_P(
    Mechanisms, AdjointGradientTest,
    ::testing::Combine(::testing::Range(std::size_t{0}, gradient_cases().size()),
                       ::testing::Values("rodas4", "rodas4p2", "rodas5p", "dopri5")),
    [](const auto& instance) {
      return gradient_cases().at(std::get<0>(instance.param)).name + "_" +
             std::get<1>(instance.param);
    });

// Of a long path only some points are stored; the steps between them are repeated.
TEST_P(AdjointGradientTest, IsTheSameFromAWayOfWhichLittleIsKept) {
  const auto& [index, method] = GetParam();
  const GradientCase test = gradient_cases().at(index);
  const auto system = test.compile(method, "auto");
  AdjointGradient whole(*system), parts(*system, 4);
  const GradientRun a = run_gradient(&whole, *system, system->parameters()),
                    b = run_gradient(&parts, *system, system->parameters());
  ASSERT_TRUE(a.status.ok() && b.status.ok());
  EXPECT_GT(a.steps, 6);
  EXPECT_LT((a.gradient - b.gradient).norm(), 1e-10 * a.gradient.norm());
}

TEST(AdjointGradient, StartsAnewToTheLastBit) {
  const auto system = servo("{}");
  AdjointGradient engine(*system);
  const std::vector<double> there = system->parameters();
  std::vector<double> elsewhere = there;
  elsewhere[0] *= 1.3;
  const GradientRun first = run_gradient(&engine, *system, there),
                    other = run_gradient(&engine, *system, elsewhere),
                    again = run_gradient(&engine, *system, there);
  ASSERT_TRUE(first.status.ok() && other.status.ok());
  EXPECT_EQ(first.gradient, again.gradient);
  EXPECT_NE(first.gradient, other.gradient);
}

TEST(AdjointGradient, AtTheStartOnlyTerminalTermsCount) {
  const auto system = servo("{}");
  RosenbrockGradient direct(*system);
  AdjointGradient adjoint(*system);
  Eigen::VectorXd a, b;
  ASSERT_TRUE(direct.start(system->parameters(), Derivatives::kGradient).ok() &&
              adjoint.start(system->parameters(), Derivatives::kGradient).ok());
  direct.gradient(&a);
  adjoint.gradient(&b);
  EXPECT_GT(a.norm(), 0.0);
  EXPECT_LT((a - b).norm(), 1e-12 * a.norm());
}

}  // namespace
}  // namespace codesign
