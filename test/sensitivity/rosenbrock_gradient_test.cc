// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "sensitivity/rosenbrock_gradient.h"

#include "sensitivity/gradient_cases.h"

namespace codesign {
namespace {

class RosenbrockGradientTest : public ::testing::TestWithParam<std::size_t> {};

// With a limit on memory the run is repeated for each further group of parameters.
TEST_P(RosenbrockGradientTest, IsTheSameInParts) {
  const GradientCase test = gradient_cases().at(GetParam());
  const auto system = test.compile("rodas4", "direct");
  RosenbrockGradient whole(*system), parts(*system, 1);
  const GradientRun a = run_gradient(&whole, *system, system->parameters()),
                    b = run_gradient(&parts, *system, system->parameters());
  ASSERT_TRUE(a.status.ok() && b.status.ok());
  EXPECT_EQ(a.steps, b.steps);
  EXPECT_EQ(a.objective, b.objective);
  const double largest = a.gradient.cwiseAbs().maxCoeff();
  EXPECT_GT(largest, 0.0);
  for (Eigen::Index k = 0; k < a.gradient.size(); ++k)
    EXPECT_NEAR(b.gradient[k], a.gradient[k], 1e-12 * std::max(std::abs(a.gradient[k]), largest))
        << "parameter " << k;
  const GradientRun again = run_gradient(&parts, *system, system->parameters());
  EXPECT_EQ(again.gradient, b.gradient);
}

INSTANTIATE_TEST_SUITE_P(Mechanisms, RosenbrockGradientTest,
                         ::testing::Range(std::size_t{0}, gradient_cases().size()),
                         [](const auto& instance) {
                           return gradient_cases().at(instance.param).name;
                         });

TEST(RosenbrockGradient, CancelledBetweenItsPartsItIsNoGradient) {
  const auto system = servo("{}");
  RosenbrockGradient parts(*system, 1);
  ASSERT_GT(system->study().tuned.size(), 1U);
  ASSERT_TRUE(parts.start(system->parameters(), Derivatives::kGradient).ok());
  while (parts.time() < system->study().duration)
    ASSERT_TRUE(parts.advance(system->study().duration).ok());
  const std::atomic<bool> cancel{true};
  parts.obey(&cancel);
  Eigen::VectorXd gradient;
  parts.gradient(&gradient);
  EXPECT_FALSE(std::isnan(gradient[0]));
  EXPECT_TRUE(std::isnan(gradient[1]));
}

}  // namespace
}  // namespace codesign
