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

// All masses scale with a parameter, by which the motion changes by rounding alone.
TEST(RosenbrockGradient, RoundingIsNoErrorOfASensitivity) {
  std::string scaled = double_pendulum();
  const auto replace = [&scaled](const std::string& from, const std::string& to) {
    for (std::size_t at = 0; (at = scaled.find(from, at)) != std::string::npos; at += to.size())
      scaled.replace(at, from.size(), to);
  };
  replace("<mass value='1'/>", "<mass value='1' codesign:value='${m}'/>");
  replace("ixx='0.0834'", "ixx='0.0834' codesign:ixx='${0.0834*m}'");
  replace("iyy='0.0834'", "iyy='0.0834' codesign:iyy='${0.0834*m}'");
  replace("izz='0.001'", "izz='0.001' codesign:izz='${0.001*m}'");
  replace("<link name='ground'/>", "<codesign:parameter name='m' value='1'/><link name='ground'/>");
  const auto steps = [&scaled](const std::string& solver) {
    const auto system = compile(
        scaled,
        "duration: 2.0\ninitial_state: {shoulder: {position: 1.2}, elbow: {velocity: 3.0}}\n"
        "parameters: {m: {initial: 1.3}}\nobjective: {integral: [{signal: "
        "shoulder/position}]}\nsolver: {" +
            solver + "}\n");
    const Evaluation evaluation = evaluator_of(system).evaluate_design({1.3}, true);
    EXPECT_TRUE(evaluation.status.ok()) << evaluation.status.cause;
    EXPECT_NEAR(evaluation.gradient[0], 0.0, 1e-9);
    return evaluation.statistics.steps;
  };
  EXPECT_LE(steps("sensitivity_tolerance: 1.0e-6"), steps("") + 5);
}

}  // namespace
}  // namespace codesign
