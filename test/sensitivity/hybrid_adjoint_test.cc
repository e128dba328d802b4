// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
// The adjoint over switches, samples and ends of runs, theory (18h), beside direct sensitivities.
// Closed forms: mode_change_test.cc, end_motion_test.cc.
#include <gtest/gtest.h>

#include "sensitivity/adjoint_gradient.h"
#include "sensitivity/gradient_check.h"
#include "sensitivity/hybrid_cases.h"
#include "sensitivity/rosenbrock_gradient.h"

namespace codesign {
namespace {

using HybridParameter = std::tuple<std::size_t, const char*>;

class HybridAdjointTest : public ::testing::TestWithParam<HybridParameter> {
 protected:
  std::shared_ptr<const CompiledSystem> system() const {
    return hybrid_cases()
        .at(std::get<0>(GetParam()))
        .compile(std::string("gradient: adjoint, ") + std::get<1>(GetParam()));
  }
};

void expect_equal(const GradientRun& a, const GradientRun& b) {
  const double largest = a.gradient.cwiseAbs().maxCoeff();
  EXPECT_GT(largest, 0.0);
  for (Eigen::Index k = 0; k < a.gradient.size(); ++k)
    EXPECT_NEAR(b.gradient[k], a.gradient[k],
                1e-10 * std::max(std::abs(a.gradient[k]), 1e-2 * largest))
        << "parameter " << k;
}

TEST_P(HybridAdjointTest, IsTheDirectGradientToRounding) {
  const auto compiled = system();
  ASSERT_TRUE(prefers_adjoint(*compiled));
  RosenbrockGradient direct(*compiled);
  AdjointGradient adjoint(*compiled);
  const GradientRun a = run_to_end(&direct, *compiled), b = run_to_end(&adjoint, *compiled);
  ASSERT_TRUE(a.status.ok()) << a.status.cause;
  ASSERT_TRUE(b.status.ok()) << b.status.cause;
  EXPECT_EQ(a.steps, b.steps);
  EXPECT_EQ(a.objective, b.objective);
  expect_equal(a, b);
  EXPECT_EQ(direct.events()->count(), adjoint.events()->count());
  // What the case is there for: an end before the duration.
  EXPECT_EQ(adjoint.integrator().is_ended(), compiled->until() != nullptr);
}

TEST_P(HybridAdjointTest, IsTheSameFromAWayOfWhichLittleIsKept) {
  const auto compiled = system();
  AdjointGradient whole(*compiled), parts(*compiled, 4);
  const GradientRun a = run_to_end(&whole, *compiled), b = run_to_end(&parts, *compiled);
  ASSERT_TRUE(a.status.ok() && b.status.ok());
  EXPECT_GT(a.steps, 10);
  expect_equal(a, b);
}

TEST_P(HybridAdjointTest, StartsAnewToTheLastBit) {
  const auto compiled = system();
  AdjointGradient engine(*compiled);
  const GradientRun first = run_to_end(&engine, *compiled), again = run_to_end(&engine, *compiled);
  ASSERT_TRUE(first.status.ok() && again.status.ok());
  EXPECT_EQ(first.gradient, again.gradient);
}

INSTANTIATE_TEST_SUITE_P(
    Mechanisms, HybridAdjointTest,
    ::testing::Combine(::testing::Range(std::size_t{0}, hybrid_cases().size()),
                       ::testing::Values("method: rodas4", "method: rodas5p, coordinates: absolute",
                                         "method: dopri5", "method: dopri5, coordinates: absolute",
                                         "method: auto")));

// The complex step takes the same steps, and differences of the objective others.
TEST(HybridAdjoint, MeetsTheComplexStepAndDifferences) {
  for (const HybridCase& test : hybrid_cases()) {
    const auto system = test.compile(
        "gradient: adjoint, method: rodas5p, relative_tolerance: 1.0e-9, absolute_tolerance: "
        "1.0e-10");
    const GradientCheck exact =
        check_design(system, system->parameters(), CheckMethod::kComplexStep, nullptr, {});
    ASSERT_TRUE(exact.status.ok()) << test.name << ": " << describe(exact.status);
    EXPECT_LT(exact.largest_relative_difference, 1e-9) << test.name;
    const GradientCheck apart =
        check_design(system, system->parameters(), CheckMethod::kRidders, nullptr, {});
    ASSERT_TRUE(apart.status.ok()) << test.name << ": " << describe(apart.status);
    EXPECT_LT(apart.largest_relative_difference, 1e-4) << test.name;
  }
}

// From nine parameters on `auto` takes the adjoint, whether or not the motion switches.
TEST(HybridAdjoint, ManyParametersGoBackOverSwitches) {
  std::string names, load;
  for (int k = 1; k <= 9; ++k) {
    names += (k > 1 ? ", t" : "t") + std::to_string(k) + ": {initial: " + std::to_string(0.05 * k) +
             ", lower: 0, upper: 0.5}";
    load += (k > 1 ? " + " : "") + ("(t < t" + std::to_string(k) + " ? 1 : 0)");
  }
  const HybridCase test{"pulsed", double_pendulum(""),
                        "duration: 0.5\ninitial_state: {shoulder: {position: 0.4}}\nparameters: {" +
                            names + "}\nloads: [{joint: elbow, effort: \"${" + load +
                            "}\"}]\nobjective: {terminal: [{signal: elbow/position}]}\n"};
  const auto automatic = test.compile("gradient: auto"), direct = test.compile("gradient: direct");
  EXPECT_TRUE(prefers_adjoint(*automatic));
  EXPECT_NE(dynamic_cast<AdjointGradient*>(make_gradient_engine(*automatic).get()), nullptr);
  const GradientRun a = run_to_end(make_gradient_engine(*direct).get(), *direct),
                    b = run_to_end(make_gradient_engine(*automatic).get(), *automatic);
  ASSERT_TRUE(a.status.ok() && b.status.ok());
  EXPECT_GT(a.gradient.cwiseAbs().minCoeff(), 1e-4);
  // The directions of the error test differ, and with them the steps.
  EXPECT_LT((a.gradient - b.gradient).norm(), 1e-5 * a.gradient.norm());
}

}  // namespace
}  // namespace codesign
