// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "sensitivity/gradient_engine.h"

#include <gtest/gtest.h>

#include "mechanism_codesign/gradient.h"
#include "sensitivity/adjoint_gradient.h"
#include "sensitivity/gradient_cases.h"
#include "sensitivity/idas_gradient.h"
#include "sensitivity/rosenbrock_gradient.h"

namespace codesign {
namespace {

const char* const kEngineRosenbrock = "{integrator: rosenbrock, method: rodas5p, relative_tolerance: 1.0e-9, absolute_tolerance: 1.0e-10}";

std::string idas(const std::string& tolerance) {
  return "{integrator: idas, relative_tolerance: " + tolerance + ", absolute_tolerance: " + tolerance + "}";
}

TEST(GradientEngine, TheStudyChooses) {
  EXPECT_NE(dynamic_cast<RosenbrockGradient*>(make_gradient_engine(*servo("{}")).get()), nullptr);
  EXPECT_NE(dynamic_cast<IdasGradient*>(make_gradient_engine(*servo("{integrator: idas}")).get()), nullptr);
}

// An extra state, terminal terms with accelerations, friction, a parameter in the initial state and one in the objective alone.
TEST(GradientEngine, TheStudyChoosesTheDirection) {
  EXPECT_NE(dynamic_cast<AdjointGradient*>(make_gradient_engine(*servo("{gradient: adjoint}")).get()), nullptr);
  EXPECT_NE(dynamic_cast<RosenbrockGradient*>(make_gradient_engine(*servo("{gradient: direct}")).get()), nullptr);
  EXPECT_FALSE(prefers_adjoint(*servo("{integrator: idas}")));
}

// gradient: auto chooses direct sensitivities for few parameters and the adjoint for many local ones, except with a sensitivity tolerance.
TEST(GradientEngine, ManyLocalParametersGoBackwards) {
  const auto prefers = [](int tuned, double sensitivity_tolerance) {
    const GeneratedCase chain = parametric_chain(12, tuned);
    GradientCase test = from_texts("chain", chain.urdf.text, chain.study.text);
    test.study.solver.sensitivity_tolerance = sensitivity_tolerance;
    return prefers_adjoint(*test.compile("rodas4", "auto"));
  };
  EXPECT_FALSE(prefers(5, 0.0));
  EXPECT_TRUE(prefers(48, 0.0));
  EXPECT_FALSE(prefers(48, 1e-4));
}

TEST(GradientEngine, TheIntegratorsAgreeToTheToleranceAskedFor) {
  const auto exact = servo(kEngineRosenbrock);
  const GradientRun reference = run_gradient(make_gradient_engine(*exact).get(), *exact, exact->parameters());
  ASSERT_TRUE(reference.status.ok()) << reference.status.cause;
  const double scale = reference.gradient.cwiseAbs().maxCoeff();
  for (const auto& [tolerance, bound] : {std::pair{"1.0e-5", 2e-3}, std::pair{"1.0e-7", 5e-5}, std::pair{"1.0e-9", 1e-6}}) {
    const auto system = servo(idas(tolerance));
    const GradientRun result = run_gradient(make_gradient_engine(*system).get(), *system, system->parameters());
    ASSERT_TRUE(result.status.ok()) << result.status.cause;
    EXPECT_NEAR(result.objective, reference.objective, bound * reference.objective) << tolerance;
    EXPECT_LT((result.gradient - reference.gradient).cwiseAbs().maxCoeff(), bound * scale) << tolerance;
  }
}

TEST(GradientEngine, IdasStartsAnewToTheLastBitWithAndWithoutGradient) {
  const auto system = servo(idas("1.0e-6"));
  const auto engine = make_gradient_engine(*system);
  const GradientRun first = run_gradient(engine.get(), *system, system->parameters()),
                    alone = run_gradient(engine.get(), *system, system->parameters(), false);
  const GradientRun second = run_gradient(engine.get(), *system, system->parameters()),
                    alone_again = run_gradient(engine.get(), *system, system->parameters(), false);
  ASSERT_TRUE(first.status.ok() && alone.status.ok());
  EXPECT_EQ(first.objective, second.objective);
  EXPECT_EQ(first.gradient, second.gradient);
  EXPECT_EQ(first.steps, second.steps);
  EXPECT_EQ(alone.objective, alone_again.objective);
  EXPECT_EQ(alone.gradient.size(), 0);
  EXPECT_NEAR(alone.objective, first.objective, 1e-3 * first.objective);
}

TEST(GradientEngine, NothingTunedIsNoGradient) {
  const auto system =
      compile(pendulum(), "duration: 0.1\nparameters: {}\nobjective: {integral: [{signal: hinge/velocity}]}\nsolver: {integrator: idas}\n");
  const GradientRun result = run_gradient(make_gradient_engine(*system).get(), *system, {});
  EXPECT_TRUE(result.status.ok());
  EXPECT_EQ(result.gradient.size(), 0);
}

TEST(GradientEngine, ACancelledEvaluationCanBeRepeated) {
  const std::atomic<bool> cancel{true};
  const auto system = servo("{gradient: adjoint}");
  Evaluator evaluator(system);
  Eigen::VectorXd rho(static_cast<Eigen::Index>(system->study().tuned.size()));
  for (Eigen::Index k = 0; k < rho.size(); ++k)
    rho[k] = system->parameters()[static_cast<std::size_t>(system->study().tuned[static_cast<std::size_t>(k)])];
  EXPECT_EQ(evaluator.evaluate(rho, true, &cancel).status.code, StatusCode::kCancelled);
  EXPECT_TRUE(evaluator.evaluate(rho, true).status.ok());
}

}  // namespace
}  // namespace codesign
